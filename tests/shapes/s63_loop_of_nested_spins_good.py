"""A callback spins its own node until the future of its request is done. Mended."""

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
        future.add_done_callback(self.on_picked)

    def on_picked(self, future):
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
