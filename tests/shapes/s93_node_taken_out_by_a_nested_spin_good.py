"""A callback spins its node until a future is done; then no executor has the node. Mended."""

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Hand(Node):
    def __init__(self):
        super().__init__('hand')
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'close', callback_group=group)
        self.create_timer(0.2, self.close, callback_group=group)

    def close(self):
        print('goes on')
        future = self.client.call_async(Trigger.Request())
        future.add_done_callback(self.on_closed)

    def on_closed(self, future):
        self.get_logger().debug('closed')


class Fingers(Node):
    def __init__(self):
        super().__init__('fingers')
        self.create_service(Trigger, 'close', self.on_close)

    def on_close(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Hand())
    executor.add_node(Fingers())
    executor.spin()


if __name__ == '__main__':
    main()
