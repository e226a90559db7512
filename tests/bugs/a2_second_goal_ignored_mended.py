"""A2: the goal is executed by a coroutine, which awaits."""

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.node import Node
from std_srvs.srv import Trigger


class Planner(Node):
    def __init__(self):
        super().__init__('planner')
        self.client = self.create_client(Trigger, 'map')
        self.server = ActionServer(self, Fibonacci, 'plan', self.execute)

    async def execute(self, goal):
        await self.client.call_async(Trigger.Request())
        goal.succeed()
        return Fibonacci.Result()


def main():
    rclpy.init()
    rclpy.spin(Planner())


if __name__ == '__main__':
    main()

# rclpy: 7.1.1
# finds: nothing
