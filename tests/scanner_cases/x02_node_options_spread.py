"""Hard: keyword arguments from a dictionary."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        options = {'qos_profile': 10, 'callback_group': ReentrantCallbackGroup()}
        self.create_subscription(String, 'in', self.on_in, **options)
        arguments = (String, 'two', self.on_two)
        self.create_subscription(*arguments, 10)

    def on_in(self, msg):
        pass

    def on_two(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group callback_group REENTRANT
#   group a_default EXCLUSIVE default
#   subscription on_in in callback_group key=in
#   subscription on_two in a_default key=two
