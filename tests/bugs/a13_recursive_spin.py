"""A13: a callback spins its own executor until another callback has run."""

import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Gate(Node):
    def __init__(self):
        super().__init__('gate')
        self.position = None
        self.create_subscription(String, 'position', self.on_position, 10)
        self.create_subscription(String, 'open', self.on_open, 10)

    def on_position(self, msg):
        self.position = msg.data

    def on_open(self, msg):
        while self.position != 'top':
            rclpy.spin_once(self, timeout_sec=0.1)


def main():
    rclpy.init()
    rclpy.spin(Gate())


if __name__ == '__main__':
    main()

# finds: CC106:20 warning
