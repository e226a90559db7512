import rclpy
import two
from rclpy.node import Node


class A(Node):
    def __init__(self):
        super().__init__('a')
        two.fill(self)

    def tick(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()
