"""EffectLog: what a callback publishes and makes."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.pub = self.create_publisher(String, 'out', 10)
        self.create_subscription(String, 'in', self.on_in, 10)

    def on_in(self, msg):
        self.send(msg)
        self.create_publisher(String, 'late', 10).publish(msg)

    def send(self, msg):
        self.pub.publish(msg)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_in in a_default key=in
#     publishes out @15>19
#     publishes late @16
