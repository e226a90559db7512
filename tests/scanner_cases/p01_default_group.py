"""P1, P6: no group is given, rclpy.spin: one exclusive group of the node, one thread."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_subscription(String, 'in', self.on_in, 10)
        self.create_timer(0.5, self.tick)

    def on_in(self, msg):
        pass

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   subscription on_in in a_default key=in
