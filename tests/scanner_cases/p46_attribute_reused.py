"""P46, point 13: two entities stored in one attribute, one not stored: all of them."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.sub = self.create_subscription(String, 'a', self.fa, 10)
        self.sub = self.create_subscription(String, 'b', self.fb, 10)
        self.create_subscription(String, 'c', self.fc, 10)

    def fa(self, msg):
        pass

    def fb(self, msg):
        pass

    def fc(self, msg):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription fa in a_default key=a
#   subscription fb in a_default key=b
#   subscription fc in a_default key=c
