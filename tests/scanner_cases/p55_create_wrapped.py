"""P55: create_* overridden with *args and **kwargs."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Base(Node):
    def create_subscription(self, *args, **kwargs):
        kwargs.setdefault('callback_group', self.group)
        return super().create_subscription(*args, **kwargs)


class A(Base):
    def __init__(self):
        super().__init__('a')
        self.group = ReentrantCallbackGroup()
        self.own = MutuallyExclusiveCallbackGroup()
        self.create_subscription(String, 'x', self.on_x, 10)
        self.create_subscription(String, 'y', self.on_y, 10, callback_group=self.own)

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
#   group own EXCLUSIVE
#   subscription on_x in group key=x
#   subscription on_y in own key=y
