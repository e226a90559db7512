"""P57: an unknown factory: the name is not resolved, the entity is sure."""
# live: no, imports a package nobody has

import rclpy
from rclpy.node import Node
from some_vendor_package import make_cb


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_timer(1.0, make_cb('x'))


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer make_cb in a_default every 1 UNRESOLVED
#   ? make_cb function
