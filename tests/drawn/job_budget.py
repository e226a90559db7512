"""Budget: each job asks the price and takes it from what is left."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger


class Account:
    """What is left."""

    def __init__(self, start):
        self._left = start
        self.jobs = 0

    @property
    def left(self):
        return self._left

    @left.setter
    def left(self, value):
        self._left = max(0, value)


class Budget(Node):
    """Takes the price of each job."""

    def __init__(self):
        super().__init__('budget')
        self.account = Account(1000)
        group = ReentrantCallbackGroup()
        self.prices = self.create_client(Trigger, 'price', callback_group=group)
        self.create_subscription(String, 'job', self.on_job, 50, callback_group=group)
        self.left_pub = self.create_publisher(Int32, 'left', 10)

    async def _price(self):
        answer = await self.prices.call_async(Trigger.Request())
        return len(answer.message)

    async def on_job(self, _msg):
        before = self.account.left
        self.account.left = before - await self._price()
        self.account.jobs += 1
        self.left_pub.publish(Int32(data=self.account.left))


def main():
    rclpy.init()
    node = Budget()
    rclpy.spin(node)


if __name__ == '__main__':
    main()
