"""P31: helpers called from __init__, with and without arguments."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self._set_up()
        self._add('x', self.on_x)
        self._add('y', self.on_y)

    def _set_up(self):
        self.group = ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.group)

    def _add(self, topic, callback):
        self.create_subscription(String, topic, callback, 10, callback_group=self.group)

    def tick(self):
        pass

    def on_x(self, msg):
        pass

    def on_y(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   timer tick in group every 0.5
#   subscription on_x in group key=x
#   subscription on_y in group key=y
