"""EffectLog: an object that a callback makes, and what is part of it, is no shared data."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Grid:
    def __init__(self):
        self.cells = None

    def fill(self, size):
        if self.cells is None or len(self.cells) != size:
            self.cells = [0] * size


class View:
    def __init__(self):
        self.grid = Grid()


class A(Node):
    def __init__(self):
        super().__init__('a')
        self.size = 3
        self.kept = None
        self.create_subscription(String, 'look', self.on_look, 10)
        self.create_subscription(String, 'size', self.on_size, 10)

    def on_look(self, msg):
        view = View()
        view.grid.fill(self.size)

    def on_size(self, msg):
        self.size = int(msg.data)


def main():
    rclpy.init()
    rclpy.spin(A())


if __name__ == '__main__':
    main()

# expect:
# unit a: SingleThreadedExecutor x1 rclpy.spin, main
#   group a_default EXCLUSIVE default
#   subscription on_look in a_default key=look
#     reads A.size @32
#   subscription on_size in a_default key=size
#     writes A.size @35
