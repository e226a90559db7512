"""A callback takes from a queue that a callback of its own group fills."""

import queue

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Packer(Node):
    def __init__(self):
        super().__init__('packer')
        self.boxes = queue.Queue()
        self.create_timer(0.3, self.pack)
        self.create_timer(0.5, self.on_box)

    def pack(self):
        box = self.boxes.get()  # waits here
        print('goes on')
        return box

    def on_box(self):
        self.boxes.put('box')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Packer())
    executor.spin()


if __name__ == '__main__':
    main()
