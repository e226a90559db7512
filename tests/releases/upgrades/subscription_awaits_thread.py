"""A subscription awaits what a thread of its own computes."""

import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Empty


class Segmenter(Node):
    def __init__(self):
        super().__init__('segmenter')
        self.images = self.create_publisher(Empty, 'image', 10)
        self.create_subscription(Empty, 'image', self.on_image, 10)
        self.once = self.create_timer(0.3, self.send)

    def send(self):
        if self.images.get_subscription_count():
            self.once.cancel()
            self.images.publish(Empty())

    async def on_image(self, message):
        done = Future()
        threading.Thread(target=self.compute, args=(done,), daemon=True).start()
        print('computing', flush=True)
        # differs: future-wakes
        print('found', await done, flush=True)

    def compute(self, done):
        time.sleep(1.0)
        done.set_result(3)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Segmenter())
    executor.spin()


if __name__ == '__main__':
    main()
