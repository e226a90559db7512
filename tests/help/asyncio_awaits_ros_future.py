"""asyncio awaits the answer of a service, which newer releases refuse."""

import asyncio
import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.client = self.create_client(Trigger, 'answer')
        self.create_service(Trigger, 'answer', self.on_request)

    def on_request(self, request, response):
        return response


async def ask(node):
    await node.client.call_async(Trigger.Request())
    print('goes on')


def main():
    rclpy.init()
    node = Asker()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    asyncio.run(ask(node))


if __name__ == '__main__':
    main()
