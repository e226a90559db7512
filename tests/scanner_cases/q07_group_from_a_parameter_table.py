"""Point 7: a group looked up by a name nobody knows."""
# live: no, depends on a parameter

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        groups = {'x': ReentrantCallbackGroup(), 'y': MutuallyExclusiveCallbackGroup()}
        name = self.declare_parameter('group', 'x').value
        self.create_timer(0.5, self.tick, callback_group=groups[name])
        self.create_timer(0.6, self.tock, callback_group=groups.get(name))

    def tick(self):
        pass

    def tock(self):
        pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   group unresolved_2 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 0.5
#   timer tock in unresolved_2 every 0.6
#   ? unresolved_1 group
#   ? unresolved_2 group
