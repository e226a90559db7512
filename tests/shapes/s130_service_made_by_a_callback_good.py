"""A callback waits for a service that a timer of another group makes."""

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.other = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'capture', callback_group=self.other)
        self.starting = self.create_timer(0.5, self.start, self.other)
        self.create_timer(0.2, self.work)

    def start(self):
        self.starting.cancel()
        self.create_service(Trigger, 'capture', self.on_capture, callback_group=self.other)

    def on_capture(self, request, response):
        return response

    def work(self):
        while not self.client.wait_for_service(timeout_sec=0.5):
            self.get_logger().info('not there yet')
        print('goes on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Camera())
    executor.spin()


if __name__ == '__main__':
    main()
