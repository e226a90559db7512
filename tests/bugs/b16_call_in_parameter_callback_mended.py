"""B16: a parameter callback asks a service; rclpy runs it in the default group. Mended."""

import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.declare_parameter('level', 1)
        self.supply = self.create_client(
            Trigger, 'supply', callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.add_on_set_parameters_callback(self.on_level)
        self.create_timer(1.0, self.report, callback_group=MutuallyExclusiveCallbackGroup())

    def on_level(self, parameters):
        answer = self.supply.call(Trigger.Request())
        return SetParametersResult(successful=answer.success)

    def report(self):
        self.get_logger().info('on')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Lamp())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
