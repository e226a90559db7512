"""P34: lambdas as callbacks."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.count = 0
        self.create_timer(1.0, lambda: self.tick(3))
        self.create_subscription(String, 'in', lambda msg: print(msg.data), 10)
        self.create_subscription(String, 'two', lambda msg: None, 10)

    def tick(self, number):
        self.count += number


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer lambda_tick in a_default (A.__init__.<locals>.<lambda>) every 1
#     writes A.count update @12>17
#   subscription lambda_print in a_default (A.__init__.<locals>.<lambda>) key=in
#   subscription lambda in a_default (A.__init__.<locals>.<lambda>) key=two
