"""P26: entities made by comprehensions."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.subs = [self.create_subscription(String, t, self.on_any, 10) for t in ('x', 'y')]
        self.timers_by_name = {n: self.create_timer(n, self.tick) for n in (1, 2)}

    def on_any(self, msg):
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
#   timer tick in a_default every 1
#   timer tick_2 in a_default (A.tick) every 2
#   subscription x_on_any in a_default (A.on_any) key=x
#   subscription y_on_any in a_default (A.on_any) key=y
