"""Main destroys a node that another thread spins, and waits for its last message. Mended."""

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
    while rclpy.ok():
        node = Camera()
        executor.add_node(node)
        node.taken.clear()
        node.taken.wait()
        print('goes on')
        executor.remove_node(node)
        node.destroy_node()


if __name__ == '__main__':
    main()
