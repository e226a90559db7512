"""A callback spins its own node until the future of its request is done."""

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Picker(Node):
    def __init__(self):
        super().__init__('picker')
        self.client = self.create_client(Trigger, 'pick')
        self.create_timer(0.5, self.pick)

    def pick(self):
        future = self.client.call_async(Trigger.Request())
        while not future.done():  # waits here
            rclpy.spin_once(self, timeout_sec=0.1)
        print('goes on')


class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.create_service(Trigger, 'pick', self.on_pick)

    def on_pick(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Picker())
    executor.add_node(Robot())
    executor.spin()


if __name__ == '__main__':
    main()
