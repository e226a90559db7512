"""Hard: a dataclass that carries the group and the topic."""

from dataclasses import dataclass

import rclpy
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


@dataclass
class Source:
    topic: str
    group: CallbackGroup


class A(Node):
    def __init__(self):
        super().__init__('a')
        group = ReentrantCallbackGroup()
        for source in (Source('x', group), Source(topic='y', group=group)):
            self.create_subscription(String, source.topic, self.on_any, 10, callback_group=source.group)

    def on_any(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group group REENTRANT
#   subscription x_on_any in group (A.on_any) key=x
#   subscription y_on_any in group (A.on_any) key=y
