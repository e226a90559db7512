"""An EventsExecutor holds its node weakly, and nobody else keeps it. Mended."""

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node


class Ghost(Node):
    def __init__(self):
        super().__init__('ghost')
        self.create_timer(0.3, self.haunt)

    def haunt(self):
        print('goes on')


def main():
    rclpy.init()
    executor = EventsExecutor()
    node = Ghost()
    executor.add_node(node)
    executor.spin()


if __name__ == '__main__':
    main()
