"""An awaited call; the client is in the exclusive group of the caller."""

import rclpy
from answering import answer_elsewhere
from rclpy import executors
from rclpy.node import Node
from std_srvs.srv import Trigger


class Caller(Node):
    def __init__(self):
        super().__init__('caller')
        self.client = self.create_client(Trigger, 'answer')
        self.client.wait_for_service()
        self.timer = self.create_timer(0.1, self.ask)

    async def ask(self):
        self.timer.cancel()
        print('asks', flush=True)
        await self.client.call_async(Trigger.Request())
        print('goes on', flush=True)


def main():
    rclpy.init()
    answer_elsewhere()
    node = Caller()
    executor = executors.MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()

# single: blocks
# multi: blocks
