"""F2: a second thread takes the transforms meanwhile."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
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
        self.buffer.lookup_transform('map', 'odom', Time(), timeout=Duration(seconds=1.0))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Asker())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
