"""A callback joins a thread that waits for an answer on the callback's only thread. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Calibrator(Node):
    def __init__(self):
        super().__init__('calibrator')
        group = MutuallyExclusiveCallbackGroup()
        self.client = self.create_client(Trigger, 'measure', callback_group=group)
        self.create_service(Trigger, 'measure', self.on_measure, callback_group=group)
        self.create_timer(0.5, self.calibrate)

    def calibrate(self):
        worker = threading.Thread(target=self.measure, daemon=True)
        worker.start()
        worker.join()
        print('goes on')

    def measure(self):
        self.client.call(Trigger.Request())

    def on_measure(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Calibrator())
    executor.spin()


if __name__ == '__main__':
    main()
