"""A node that has done its work shuts rclpy down from its timer."""

import rclpy
from rclpy.node import Node


class Calibration(Node):
    def __init__(self):
        super().__init__('calibration')
        self.samples = 0
        self.create_timer(0.2, self.sample)

    def sample(self):
        self.samples += 1
        if self.samples == 3:
            # differs: shutdown-waits-not
            rclpy.shutdown()
            print('done', flush=True)


def main():
    rclpy.init()
    try:
        rclpy.spin(Calibration())
    except rclpy.executors.ExternalShutdownException:
        print('shut down', flush=True)
    print('end', flush=True)


if __name__ == '__main__':
    main()
