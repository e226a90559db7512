"""A callback that checks parameters waits for an answer on the thread that sets them. Mended."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger


class Motor(Node):
    def __init__(self):
        super().__init__('motor')
        self.declare_parameter('speed', 0)
        group = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'limit', callback_group=group)
        self.create_service(Trigger, 'limit', self.on_limit, callback_group=group)
        self.add_on_set_parameters_callback(self.check)
        self.create_timer(0.5, self.accelerate)

    def accelerate(self):
        self.set_parameters([Parameter('speed', value=1)])
        print('goes on')

    def check(self, parameters):
        self.client.call(Trigger.Request())
        return SetParametersResult(successful=True)

    def on_limit(self, request, response):
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Motor())
    executor.spin()


if __name__ == '__main__':
    main()
