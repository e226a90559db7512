"""A callback joins a queue whose worker never says that a task is done."""

import queue
import threading

import rclpy
from rclpy.node import Node


class Uploader(Node):
    def __init__(self):
        super().__init__('uploader')
        self.files = queue.Queue()
        threading.Thread(target=self.upload, daemon=True).start()
        self.create_timer(0.3, self.flush)

    def flush(self):
        self.files.put('bag')
        self.files.join()  # waits here
        print('goes on')

    def upload(self):
        while True:
            self.files.get()


def main():
    rclpy.init()
    rclpy.spin(Uploader())


if __name__ == '__main__':
    main()
