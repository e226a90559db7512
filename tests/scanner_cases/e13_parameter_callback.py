"""EffectLog: a function of add_on_set_parameters_callback runs in a service of rclpy itself, in the default group."""

import rclpy
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.gain = self.declare_parameter('gain', 1.0).value
        self.add_on_set_parameters_callback(self.on_set)
        self.create_timer(1.0, self.tick)

    def on_set(self, parameters):
        self.gain = parameters[0].value

    def tick(self):
        print(self.gain)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 1
#     reads A.gain @18
#   parameter_service on_set in a_default
#     writes A.gain @15
