"""A callback before the set waits on a condition of the setting callback's group. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter


class Valve(Node):
    def __init__(self):
        super().__init__('valve')
        self.declare_parameter('open', False)
        self.closed = threading.Condition()
        self.add_pre_set_parameters_callback(self.before)
        self.create_timer(0.5, self.turn)
        self.create_timer(0.3, self.on_closed, callback_group=MutuallyExclusiveCallbackGroup())

    def turn(self):
        self.set_parameters([Parameter('open', value=True)])
        print('goes on')

    def before(self, parameters):
        with self.closed:
            self.closed.wait()
        return parameters

    def on_closed(self):
        with self.closed:
            self.closed.notify_all()


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Valve())
    executor.spin()


if __name__ == '__main__':
    main()
