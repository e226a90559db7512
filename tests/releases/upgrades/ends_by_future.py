"""The work is done when its future is, and `main` shuts down."""

import rclpy
from rclpy.node import Node
from rclpy.task import Future


class Calibration(Node):
    def __init__(self):
        super().__init__('calibration')
        self.samples = 0
        self.done = Future()
        self.create_timer(0.2, self.sample)

    def sample(self):
        self.samples += 1
        if self.samples == 3:
            self.done.set_result(True)


def main():
    rclpy.init()
    node = Calibration()
    rclpy.spin_until_future_complete(node, node.done)
    node.destroy_node()
    rclpy.shutdown()
    print('end', flush=True)


if __name__ == '__main__':
    main()
