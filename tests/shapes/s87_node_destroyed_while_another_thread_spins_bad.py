"""Main destroys a node that another thread spins, and waits for its last message."""

import threading

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class Camera(Node):
    def __init__(self):
        super().__init__('camera')
        self.taken = threading.Event()
        self.create_timer(0.1, self.take)

    def take(self):
        self.taken.set()


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    spinner = threading.Thread(target=executor.spin, daemon=True)
    spinner.start()
    node = Camera()
    executor.add_node(node)
    while rclpy.ok():
        node.taken.clear()
        node.taken.wait()  # waits here
        print('goes on')
        node.destroy_node()


if __name__ == '__main__':
    main()
