"""A callback spins its executor until a future of its own group is done."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Cook(Node):
    def __init__(self):
        super().__init__('cook')
        self.client = self.create_client(Trigger, 'taste')
        self.create_timer(0.5, self.cook)

    def cook(self):
        future = self.client.call_async(Trigger.Request())
        self.executor.spin_until_future_complete(future)  # waits here
        print('goes on')


class Taster(Node):
    def __init__(self):
        super().__init__('taster')
        self.create_service(Trigger, 'taste', self.on_request)

    def on_request(self, request, response):
        return response


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Cook())
    executor.add_node(Taster())
    executor.spin()


if __name__ == '__main__':
    main()
