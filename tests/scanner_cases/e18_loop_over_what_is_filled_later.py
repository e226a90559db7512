"""EffectLog: a loop over, and the length of, what is empty at first and filled by a later callback."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Courier(Node):
    def __init__(self):
        super().__init__('courier')
        self.parcels = []
        self.doors = {}
        self.wanted = []
        self.client = self.create_client(Trigger, 'door')
        self.create_timer(1.0, self.deliver)
        self.create_timer(2.0, self.count)
        self.create_subscription(String, 'parcel', self.on_parcel, 10)

    def deliver(self):
        for parcel in self.parcels:
            self.client.call(Trigger.Request())

    def count(self):
        if len(self.doors) > 3:
            self.client.call(Trigger.Request())

    def on_parcel(self, msg):
        self.parcels.append(msg)
        self.doors[msg.data] = msg

    def want(self, topic):
        self.wanted.append(topic)

    def open(self):
        for topic in self.wanted:
            self.create_subscription(String, topic, self.on_parcel, 10)


def main():
    rclpy.init()
    rclpy.spin(Courier())

# expect:
# unit courier: SingleThreadedExecutor x1 rclpy.spin, main
#   group courier_default EXCLUSIVE default
#   timer deliver in courier_default every 1
#     blocks client.call on door_client @22
#     reads Courier.parcels iterates list @21
#   timer count in courier_default every 2
#     blocks client.call on door_client conditional @26
#     reads Courier.doors @25
#   subscription parcel_on_parcel in courier_default (Courier.on_parcel) key=parcel
#     reads Courier.doors @30
#     writes Courier.parcels update in_place @29
#     writes Courier.doors update in_place @30
#   subscription on_parcel in courier_default key=? conditional count=? when=later
#     reads Courier.doors @30
#     writes Courier.parcels update in_place @29
#     writes Courier.doors update in_place @30
#   client door_client in courier_default key=door
#   ? on_parcel topic
#   ? on_parcel count
