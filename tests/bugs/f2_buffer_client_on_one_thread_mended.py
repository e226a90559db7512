"""F2: a buffer of its own, asked for what is there."""

import rclpy
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Empty
from tf2_ros import Buffer, TransformListener


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_subscription(Empty, 'ask', self.on_ask, 10)

    def on_ask(self, msg):
        if self.buffer.can_transform('map', 'odom', Time()):
            self.buffer.lookup_transform('map', 'odom', Time())


def main():
    rclpy.init()
    rclpy.spin(Asker())


if __name__ == '__main__':
    main()

# finds: nothing
