"""One subscription of a ParameterEventHandler."""
# live: no, the subscription is of the library

import rclpy
from rclpy.node import Node
from rclpy.parameter_event_handler import ParameterEventHandler


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.handler = ParameterEventHandler(self)
        self.handle = self.handler.add_parameter_callback('gain', 'a', self.on_gain)

    def on_gain(self, parameter):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_gain in a_default key=/parameter_events library=rclpy.ParameterEventHandler
