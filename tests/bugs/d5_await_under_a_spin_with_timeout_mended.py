"""D5: the release of rclpy is one that has the change."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'answer', callback_group=group)
        self.create_timer(1.0, self.ask, callback_group=group)
        self.create_timer(2.0, self.log, callback_group=group)

    async def ask(self):
        await self.client.call_async(Trigger.Request())

    def log(self):
        self.get_logger().info('alive')


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Asker())
    executor.spin_until_future_complete(Future(), timeout_sec=60.0)


if __name__ == '__main__':
    main()

# rclpy: 3.3.11
# finds: nothing
