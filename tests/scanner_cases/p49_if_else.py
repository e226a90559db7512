"""P49, point 12: both branches make something: alternatives, never both certain."""
# live: no, depends on a parameter

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.declare_parameter('sim', False)
        if self.get_parameter('sim').value:
            self.create_subscription(String, '/clock', self.on_clock, 10)
        else:
            self.create_timer(0.1, self.on_timer)

    def on_clock(self, msg):
        pass

    def on_timer(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer on_timer in a_default every 0.1 conditional alternative@13.1
#   subscription on_clock in a_default key=/clock conditional alternative@13.0
