"""A parameter service runs a callback that waits for an event of the default group. Mended."""

import threading

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.parameter_client import AsyncParameterClient


class Filter(Node):
    def __init__(self):
        super().__init__('filter')
        self.declare_parameter('size', 1)
        self.idle = threading.Event()
        self.create_timer(0.4, self.work, callback_group=MutuallyExclusiveCallbackGroup())
        self.add_on_set_parameters_callback(self.resize)

    def work(self):
        self.idle.set()

    def resize(self, parameters):
        self.idle.clear()
        self.idle.wait()
        print('goes on')
        return SetParametersResult(successful=True)


class Tuner(Node):
    def __init__(self):
        super().__init__('tuner')
        self.client = AsyncParameterClient(self, 'filter')
        self.create_timer(0.6, self.tune)

    def tune(self):
        self.client.set_parameters([Parameter('size', value=3)])


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(Filter())
    executor.add_node(Tuner())
    executor.spin()


if __name__ == '__main__':
    main()
