"""Main spins until a future is done that no callback sets."""

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Mission(Node):
    def __init__(self):
        super().__init__('mission')
        self.finished = Future()
        self.count = 0
        self.create_timer(0.3, self.fly)

    def fly(self):
        self.count += 1
        if self.count == 3:
            self.get_logger().info('finished')


def main():
    rclpy.init()
    node = Mission()
    rclpy.spin_until_future_complete(node, node.finished)  # waits here
    print('goes on')
    node.destroy_node()
    rclpy.shutdown()


if __name__ == '__main__':
    main()
