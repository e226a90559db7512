"""A future awaited in a callback and done by a foreign thread wakes no executor."""

import threading

import rclpy
from rclpy import executors
from rclpy.node import Node
from rclpy.task import Future


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.future = Future()
        self.timer = self.create_timer(0.1, self.ask)

    async def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        threading.Timer(0.2, self.future.set_result, [1]).start()
        threading.Timer(0.8, self.wake).start()
        await self.future
        print('goes on', flush=True)

    def wake(self):
        print('is woken', flush=True)
        self.executor.wake()


def main():
    rclpy.init()
    node = Waiter()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: asleep
# multi: asleep
# single with future-wakes: ok
# multi with future-wakes: ok
