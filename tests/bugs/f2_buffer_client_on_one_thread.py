"""F2: a buffer client waits for a server whose answer nobody can take."""

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from std_msgs.msg import Empty
from tf2_ros import BufferClient


class Asker(Node):
    def __init__(self):
        super().__init__('asker')
        self.buffer = BufferClient(self, 'tf2_buffer_server')
        self.create_subscription(Empty, 'ask', self.on_ask, 10)

    def on_ask(self, msg):
        self.buffer.lookup_transform('map', 'odom', Time(), timeout=Duration(seconds=1.0))


def main():
    rclpy.init()
    rclpy.spin(Asker())


if __name__ == '__main__':
    main()

# finds: CC102:18 warning
