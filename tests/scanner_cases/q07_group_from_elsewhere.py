"""Point 7: a group imported from a package that is not found."""
# live: no, imports a package nobody has

import rclpy
from rclpy.node import Node
from some_vendor_package import SHARED_GROUP, make_group


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.own = make_group()
        self.create_timer(0.5, self.tick, callback_group=SHARED_GROUP)
        self.create_timer(0.6, self.tock, callback_group=self.own)
        self.create_timer(0.7, self.tack, callback_group=self.own)

    def tick(self):
        pass

    def tock(self):
        pass

    def tack(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group unresolved_1 EXCLUSIVE UNRESOLVED
#   group unresolved_2 EXCLUSIVE UNRESOLVED
#   timer tick in unresolved_1 every 0.5
#   timer tock in unresolved_2 every 0.6
#   timer tack in unresolved_2 every 0.7
#   ? unresolved_1 group
#   ? unresolved_2 group
