"""A task waits for another task of its own pool of one thread."""

from concurrent.futures import ThreadPoolExecutor

import rclpy
from rclpy.node import Node


class Stitcher(Node):
    def __init__(self):
        super().__init__('stitcher')
        self.pool = ThreadPoolExecutor(max_workers=1)
        self.create_timer(0.5, self.stitch)

    def stitch(self):
        self.pool.submit(self.join_images).result()  # waits here
        print('goes on')

    def join_images(self):
        return self.pool.submit(self.load_image).result()  # waits here

    def load_image(self):
        return 'image'


def main():
    rclpy.init()
    rclpy.spin(Stitcher())


if __name__ == '__main__':
    main()
