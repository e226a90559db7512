"""A timer that spins its own node until a flag comes."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.ready = False
        self.create_subscription(Bool, 'ready', self.on_ready, 10)
        self.create_timer(0.3, self.move)

    def on_ready(self, message):
        self.ready = message.data

    def move(self):
        # differs: spin-refused-twice
        rclpy.spin_once(self, timeout_sec=0.1)
        print('moved', flush=True)


def main():
    rclpy.init()
    rclpy.spin(Arm())


if __name__ == '__main__':
    main()
