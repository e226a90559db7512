"""G4: both take the locks in one order."""

import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String


class Mux(Node):
    def __init__(self):
        super().__init__('mux')
        self.plan_lock, self.motor_lock = threading.Lock(), threading.Lock()
        self.create_subscription(
            String, 'move', self.on_move, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.create_subscription(
            String, 'stop', self.on_stop, 10, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def on_move(self, msg):
        with self.plan_lock, self.motor_lock:
            self.get_logger().info('move')

    def on_stop(self, msg):
        with self.plan_lock:
            self.clear()

    def clear(self):
        with self.motor_lock:
            self.get_logger().info('stop')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Mux())
    executor.spin()


if __name__ == '__main__':
    main()

# finds: nothing
