"""Point 6: the attribute behind the default group, read and replaced."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import String


class Replaced(Node):
    def __init__(self):
        super().__init__('replaced')
        self.create_timer(1.0, self.before)
        self._default_callback_group = ReentrantCallbackGroup()
        self.create_timer(1.0, self.tick)
        self.create_subscription(
            String, 'in', self.on_in, 10, callback_group=self.default_callback_group
        )
        self.create_subscription(String, 'none', self.on_none, 10, callback_group=None)

    def before(self):
        pass

    def tick(self):
        pass

    def on_in(self, msg):
        pass

    def on_none(self, msg):
        pass


class Read(Node):
    def __init__(self):
        self._default_callback_group = MutuallyExclusiveCallbackGroup()
        super().__init__('read')
        self.create_timer(1.0, self.plain)
        self.create_timer(1.0, self.named, callback_group=self._default_callback_group)

    def plain(self):
        pass

    def named(self):
        pass


def main():
    rclpy.init()
    executor = rclpy.executors.MultiThreadedExecutor(num_threads=3)
    executor.add_node(Replaced())
    executor.add_node(Read())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit replaced_and_read: MultiThreadedExecutor x3 spin, main
#   nodes replaced, read
#   group replaced_default EXCLUSIVE default
#   group _default_callback_group REENTRANT
#   group read_default EXCLUSIVE default
#   timer before in replaced_default every 1 node=replaced
#   timer tick in _default_callback_group every 1 node=replaced
#   subscription on_in in _default_callback_group key=in node=replaced
#   subscription on_none in _default_callback_group key=none node=replaced
#   timer plain in read_default every 1 node=read
#   timer named in read_default every 1 node=read
