import rclpy
from behaviour import Behaviour
from rclpy.node import Node


class Tree(Node):
    def __init__(self):
        super().__init__('right')
        self.behaviour = Behaviour()
        self.create_timer(2.0, self.beat)

    def beat(self):
        pass


def main():
    rclpy.init()
    rclpy.spin(Tree())


if __name__ == '__main__':
    main()
