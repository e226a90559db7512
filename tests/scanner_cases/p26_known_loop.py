"""P26: loops over literals are unrolled."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        for name in ('x', 'y'):
            self.create_subscription(String, name, self.on_any, 10)
        for number in range(2):
            self.create_timer(0.5 + number, self.tick)
        for topic, period in {'p': 1.0, 'q': 2.0}.items():
            self.create_subscription(String, topic, self.on_item, 10)

    def on_any(self, msg):
        pass

    def tick(self):
        pass

    def on_item(self, msg):
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
#   timer tick_2 in a_default (A.tick) every 1.5
#   subscription x_on_any in a_default (A.on_any) key=x
#   subscription y_on_any in a_default (A.on_any) key=y
#   subscription p_on_item in a_default (A.on_item) key=p
#   subscription q_on_item in a_default (A.on_item) key=q
