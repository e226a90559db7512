"""Point 10: tasks of the executor are in no group."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        self.executor.create_task(self.work)

    def work(self):
        pass


async def begin():
    pass


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(A())
    executor.create_task(begin)
    executor.spin()


if __name__ == '__main__':
    main()

# expect:
# unit a: MultiThreadedExecutor x2 spin, main
#   group a_default EXCLUSIVE default
#   group no_group REENTRANT groupless
#   timer tick in a_default every 0.5
#     changes task @14
#   task begin in no_group coroutine
#   task work in no_group conditional when=callback
