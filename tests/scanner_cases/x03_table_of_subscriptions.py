"""Hard: a table of topics and callbacks."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        fast = ReentrantCallbackGroup()
        table = [('x', self.on_x, fast), ('y', self.on_y, None), ('z', self.on_z, fast)]
        for topic, callback, group in table:
            self.create_subscription(String, topic, callback, 10, callback_group=group)

    def on_x(self, msg):
        pass

    def on_y(self, msg):
        pass

    def on_z(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group fast REENTRANT
#   group a_default EXCLUSIVE default
#   subscription on_x in fast key=x
#   subscription on_y in a_default key=y
#   subscription on_z in fast key=z
