"""Point 19: classes called Node that are none of rclpy."""

import rclpy


class Node:
    def __init__(self, name):
        self.name = name

    def create_timer(self, period, callback):
        return (period, callback)


class Tree(Node):
    def __init__(self):
        super().__init__('tree')
        self.create_timer(1.0, self.grow)

    def grow(self):
        pass


def main():
    rclpy.init()
    Tree()


if __name__ == '__main__':
    main()

# expect:
# nothing
