"""Hard: set-up inside a coroutine, the executor in a thread pool."""

import asyncio

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(0.5, self.tick)

    def tick(self):
        pass


async def run():
    executor = SingleThreadedExecutor()
    executor.add_node(A())
    loop = asyncio.get_running_loop()
    await loop.run_in_executor(None, executor.spin)


def main():
    rclpy.init()
    asyncio.run(run())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 spin in thread, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   activity main main
#     blocks await on Future @28>23
#       ended by outside @23
