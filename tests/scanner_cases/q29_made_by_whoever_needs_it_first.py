"""P31: several methods that no known code calls lead to what is made while it is missing: one."""
# live: no, nobody calls them

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.out = None
        self.clients = {}

    def publisher(self):
        if self.out is None:
            self.out = self.create_publisher(String, 'lamp', 1)
            self.create_timer(0.5, self.show)
        return self.out

    def show(self):
        self.publisher().publish(String())

    def update(self):
        self.show()

    def set_colour(self, colour):
        self.colour = colour
        self.update()

    def set_state(self, state):
        self.state = state
        self.update()

    def watch(self, topic):
        self.create_subscription(String, topic, self.on_message, 10)

    def watch_left(self):
        self.watch('left')

    def watch_right(self):
        self.watch('right')

    def client(self, name):
        if name not in self.clients:
            self.clients[name] = self.create_client(Trigger, name)
        return self.clients[name]

    def ask_one(self, one):
        self.client(one)

    def ask_other(self, other):
        self.client(other)

    def on_message(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(Lamp())


if __name__ == '__main__':
    main()

# expect:
# unit lamp: SingleThreadedExecutor x1 rclpy.spin, main
#   group lamp_default EXCLUSIVE default
#   timer show in lamp_default every 0.5 conditional when=later
#     reads Lamp.out @23>17
#     reads Lamp.out @23>20
#     writes Lamp.out rests under Lamp.out (flag) @23>18
#     publishes lamp conditional @23
#     changes timer holding Lamp.out (flag) @23>19
#   subscription left_on_message in lamp_default (Lamp.on_message) key=left conditional when=later
#   subscription right_on_message in lamp_default (Lamp.on_message) key=right conditional when=later
#   client client in lamp_default key=? conditional when=later
#   client client_2 in lamp_default key=? conditional when=later
#   ? client service
#   ? client_2 service
