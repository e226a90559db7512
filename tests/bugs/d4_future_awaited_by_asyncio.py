"""D4: asyncio awaits an rclpy future, which raises from rclpy 7.1.9 on."""

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


async def ask(node):
    return await node.client.call_async(Trigger.Request())


def main():
    rclpy.init()
    node = Asker()
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()
    asyncio.run(ask(node))


if __name__ == '__main__':
    main()

# rclpy: 7.1.9

# finds: CC114:19
