"""P26: the loop is in the caller of a helper."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for name in ('x', 'y'):
            self.watch(name)

    def watch(self, name):
        self.create_subscription(String, name, self.on_any, 10)

    def on_any(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription x_on_any in a_default (A.on_any) key=x
#   subscription y_on_any in a_default (A.on_any) key=y
