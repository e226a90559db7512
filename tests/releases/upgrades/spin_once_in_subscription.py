"""A callback waits for the next position by spinning its own executor."""

import rclpy
from geometry_msgs.msg import Point
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


class Tracker(Node):
    def __init__(self):
        super().__init__('tracker')
        group = ReentrantCallbackGroup()
        self.position = None
        self.points = self.create_publisher(Point, 'position', 10)
        self.starts = self.create_publisher(Empty, 'start', 10)
        self.create_subscription(Point, 'position', self.on_position, 10, callback_group=group)
        self.create_subscription(Empty, 'start', self.on_start, 10, callback_group=group)
        self.once = self.create_timer(0.5, self.begin, callback_group=group)

    def begin(self):
        if self.starts.get_subscription_count() and self.points.get_subscription_count():
            self.once.cancel()
            self.starts.publish(Empty())

    def on_position(self, message):
        self.position = message
        print('position', flush=True)

    def on_start(self, message):
        self.points.publish(Point())
        while self.position is None:
            # differs: spin-refused-twice
            self.executor.spin_once(timeout_sec=0.1)
        print('started', flush=True)


def main():
    rclpy.init()
    executor = SingleThreadedExecutor()
    executor.add_node(Tracker())
    executor.spin()


if __name__ == '__main__':
    main()
