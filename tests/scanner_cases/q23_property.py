"""Point 23: a property that gives the callback, the group or the topic."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self._group = ReentrantCallbackGroup()
        self.create_subscription(
            String, self.topic, self.handler, 10, callback_group=self.group
        )

    @property
    def topic(self):
        return 'in'

    @property
    def group(self):
        return self._group

    @property
    def handler(self):
        return self.on_in

    def on_in(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group _group REENTRANT
#   subscription on_in in _group key=in
