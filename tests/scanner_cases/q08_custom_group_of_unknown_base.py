"""Point 8: a group class from elsewhere."""
# live: no, imports a package nobody has

import rclpy
from rclpy.node import Node
from some_vendor_package import ReentrantCallbackGroup


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.g = ReentrantCallbackGroup()
        self.create_timer(0.5, self.tick, callback_group=self.g)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 0.5
#   ? unresolved_1 group
