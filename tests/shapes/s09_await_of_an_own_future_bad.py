"""A coroutine awaits a future that a callback of its own group sets."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String


class Grasper(Node):
    def __init__(self):
        super().__init__('grasper')
        other = MutuallyExclusiveCallbackGroup()
        self.touched = Future()
        self.commands = self.create_publisher(String, 'grasp', 10)
        self.create_subscription(String, 'grasp', self.on_grasp, 10)
        self.create_timer(0.4, self.command, callback_group=other)
        self.create_timer(0.5, self.on_touch)

    def command(self):
        self.commands.publish(String())

    async def on_grasp(self, msg):
        self.touched = Future(executor=self.executor)
        await self.touched  # waits here
        print('goes on')

    def on_touch(self):
        if not self.touched.done():
            self.touched.set_result(True)


def main():
    rclpy.init()
    rclpy.spin(Grasper())


if __name__ == '__main__':
    main()
