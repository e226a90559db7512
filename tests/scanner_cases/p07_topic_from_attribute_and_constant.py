"""P7: names from constants, attributes, f-strings and additions are folded."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


TOPIC = 'in'
NS = '/robot'


class A(Node):
    SERVICE = 'go'

    def __init__(self):
        super().__init__('a')
        self.prefix = NS + '/arm'
        self.create_subscription(String, TOPIC, self.on_one, 10)
        self.create_subscription(String, f'{NS}/two', self.on_two, 10)
        self.create_subscription(String, self.prefix + '/three', self.on_three, 10)
        self.create_subscription(String, '%s/four' % NS, self.on_four, 10)
        self.create_subscription(String, '{}/five'.format(NS), self.on_five, 10)
        self.create_service(Trigger, self.SERVICE, self.on_go)

    def on_one(self, msg):
        pass

    def on_two(self, msg):
        pass

    def on_three(self, msg):
        pass

    def on_four(self, msg):
        pass

    def on_five(self, msg):
        pass

    def on_go(self, request, response):
        return response


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_one in a_default key=in
#   subscription on_two in a_default key=/robot/two
#   subscription on_three in a_default key=/robot/arm/three
#   subscription on_four in a_default key=/robot/four
#   subscription on_five in a_default key=/robot/five
#   service on_go in a_default key=go
