"""C3: a subscription never runs: whenever its group opens, the timer is due."""

import time

import rclpy
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Image


class Tracker(Node):
    def __init__(self):
        super().__init__('tracker')
        self.create_timer(0.05, self.predict)
        self.create_subscription(Image, 'image', self.on_image, 10)

    def predict(self):
        time.sleep(0.06)

    def on_image(self, msg):
        self.get_logger().info('image')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Tracker())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: CC202:18 warning, CC401:26 warning
