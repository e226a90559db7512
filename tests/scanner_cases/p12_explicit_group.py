"""P12, P27, P35: a group in an attribute next to the default one."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = ReentrantCallbackGroup()
        self.create_subscription(String, 'a', self.on_a, 10, callback_group=self.g)
        self.create_subscription(String, 'b', self.on_b, 10)

    def on_a(self, msg):
        pass

    def on_b(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group g REENTRANT
#   group a_default EXCLUSIVE default
#   subscription on_a in g key=a
#   subscription on_b in a_default key=b
