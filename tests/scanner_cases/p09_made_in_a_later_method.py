"""P9: made in a method that main calls: exists at start; in one that nobody calls: later."""
# live: no, what nobody calls is not there

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')

    def begin(self):
        self.create_timer(0.5, self.tick)

    def watch(self, topic):
        self.create_subscription(String, topic, self.on_in, 10)

    def tick(self):
        pass

    def on_in(self, msg):
        pass


def main():
    rclpy.init()
    node = A()
    node.begin()
    rclpy.spin(node)


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   timer tick in a_default every 0.5
#   subscription on_in in a_default key=? conditional when=later
#   ? on_in topic
