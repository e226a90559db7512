"""A16: two threads call rclpy.spin, each with a node of its own: that is one executor. Mended."""

import threading

import rclpy
from rclpy.node import Node


class Clock(Node):
    def __init__(self, name):
        super().__init__(name)
        self.create_timer(0.1, self.tick)

    def tick(self):
        self.get_logger().info('tick')


def main():
    rclpy.init()
    first, second = Clock('first'), Clock('second')
    executor = rclpy.executors.SingleThreadedExecutor()
    executor.add_node(first)
    threading.Thread(target=executor.spin, daemon=True).start()
    rclpy.spin(second)


if __name__ == '__main__':
    main()

# finds: nothing
