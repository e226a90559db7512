"""Point 6: a class that overrides the property of the default group; a node that may be one."""
# live: no, a live hook sees the real groups, and nobody makes a Helper

import rclpy
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class OncePerEntity(CallbackGroup):
    def can_execute(self, entity):
        return entity not in self.running


class Free(Node):
    def __init__(self):
        self._own = ReentrantCallbackGroup()
        super().__init__('free')
        self.create_timer(1.0, self.tick)
        self.create_timer(1.0, self.tock, callback_group=None)

    @property
    def default_callback_group(self):
        return self._own

    def tick(self):
        pass

    def tock(self):
        pass


class Custom(Node):
    def __init__(self):
        self._own = OncePerEntity()
        super().__init__('custom')
        self.create_timer(1.0, self.tick)

    @property
    def default_callback_group(self):
        return self._own

    def tick(self):
        pass


class Kept(Node):
    def __init__(self):
        super().__init__('kept')
        self.create_timer(1.0, self.tick)

    @property
    def default_callback_group(self):
        return super().default_callback_group

    def tick(self):
        pass


class Helper:
    def __init__(self, node):
        node.create_timer(1.0, self.check)

    def check(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    for node in (Free(), Custom(), Kept()):
        executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit free_and_2_more: MultiThreadedExecutor x3 spin, main
#   nodes free, custom, kept
#   group _own REENTRANT
#   group _own_2 EXCLUSIVE class=OncePerEntity UNRESOLVED
#   group kept_default EXCLUSIVE default
#   timer free_tick in _own (Free.tick) every 1 node=free
#   timer tock in _own every 1 node=free
#   timer custom_tick in _own_2 (Custom.tick) every 1 node=custom
#   timer kept_tick in kept_default (Kept.tick) every 1 node=kept
#   ? _own_2 group
# unit node: no executor
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer check in unresolved_1 every 1 node=?
#   ? check node
#   ? unresolved_1 group
#   ? executor executor
