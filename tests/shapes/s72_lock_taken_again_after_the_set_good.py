"""A callback sets a parameter under a lock that the callback after the set takes. Mended."""

import threading

import rclpy
from rclpy.node import Node
from rclpy.parameter import Parameter


class Gain(Node):
    def __init__(self):
        super().__init__('gain')
        self.declare_parameter('gain', 1.0)
        self.lock = threading.Lock()
        self.add_post_set_parameters_callback(self.after)
        self.create_timer(0.4, self.adapt)

    def adapt(self):
        self.set_parameters([Parameter('gain', value=2.0)])
        print('goes on')

    def after(self, parameters):
        with self.lock:
            self.gain = parameters[0].value


def main():
    rclpy.init()
    rclpy.spin(Gain())


if __name__ == '__main__':
    main()
