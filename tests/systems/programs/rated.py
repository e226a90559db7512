"""Declares parameters of several types."""

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.node import Node
from rclpy.parameter import Parameter


class Rated(Node):
    def __init__(self):
        super().__init__('rated')
        self.declare_parameter('rate', 10.0)
        self.declare_parameter('label', 'camera', ParameterDescriptor(description='its name'))
        self.declare_parameter('gain', Parameter.Type.DOUBLE)
        self.declare_parameters('', [('sizes', [1, 2]), ('count', 1)])
        self.declare_parameter('any', 1, ParameterDescriptor(dynamic_typing=True))
        self.declare_parameter('own', 1, ignore_override=True)
        self.declare_parameter('late')
        self.create_timer(0.5, self.tick)

    def tick(self):
        print('goes on', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Rated())


if __name__ == '__main__':
    main()
