"""G2: inconsistent state, since two groups change it on several threads. Mended."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.lock = threading.Lock()
        self.count = 0
        self.create_timer(1.0, self.report, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_subscription(String, 'part', self.on_part, 10)

    def on_part(self, msg):
        with self.lock:
            self.count += 1

    def report(self):
        with self.lock:
            self.get_logger().info(str(self.count))
            self.count = 0


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Counter())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
