"""EffectLog: a list that is empty at first and filled by a callback that is made after this one."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Courier(Node):
    def __init__(self):
        super().__init__('courier')
        self.parcels = []
        self.client = self.create_client(Trigger, 'door')
        self.create_timer(1.0, self.deliver)
        self.create_subscription(String, 'parcel', self.on_parcel, 10)

    def deliver(self):
        if not self.parcels:
            return
        self.client.call(Trigger.Request())

    def on_parcel(self, msg):
        self.parcels.append(msg)


def main():
    rclpy.init()
    rclpy.spin(Courier())


if __name__ == '__main__':
    main()

# expect:
# unit courier: SingleThreadedExecutor x1 rclpy.spin, main
#   group courier_default EXCLUSIVE default
#   timer deliver in courier_default every 1
#     blocks client.call on door_client conditional @20
#     reads Courier.parcels @18
#   subscription on_parcel in courier_default key=parcel
#     writes Courier.parcels update in_place @23
#   client door_client in courier_default key=door
