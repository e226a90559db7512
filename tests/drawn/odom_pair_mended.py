# Odometry watcher: keeps the last pose and twist, a controller in another group computes from both.
# The simulated base always drives with linear.x == position.x, so a mixed pair is seen at once.
import threading

import rclpy
from nav_msgs.msg import Odometry
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class OdomSubscriber:
    """Smooths nothing, remembers the last sample."""

    def __init__(self, node: Node, topic: str):
        self._group = MutuallyExclusiveCallbackGroup()
        self._x = 0.0
        self._speed = 0.0
        self._lock = threading.Lock()
        node.create_subscription(Odometry, topic, self._on_odom, 20, callback_group=self._group)

    def _on_odom(self, msg: Odometry):
        with self._lock:
            self._x = msg.pose.pose.position.x
            _ = [abs(c) for c in msg.pose.covariance]
            self._speed = msg.twist.twist.linear.x

    def sample(self):
        with self._lock:
            x = self._x
            speed = self._speed
            return x, speed


class Controller(Node):
    def __init__(self):
        super().__init__('controller')
        self._odom = OdomSubscriber(self, 'odom')
        self._checked = 0
        self._torn = 0
        self.create_timer(
            0.002, self._control, callback_group=MutuallyExclusiveCallbackGroup())

    def _control(self):
        for _ in range(20):
            x, speed = self._odom.sample()
            self._checked += 1
            if x != speed:
                self._torn += 1
        if self._checked % 10000 == 0:
            print(f'TORN {self._torn} of {self._checked}', flush=True)


class Base(Node):
    def __init__(self):
        super().__init__('base')
        self._pub = self.create_publisher(Odometry, 'odom', 20)
        self._x = 0.0
        self.create_timer(0.005, self._drive)

    def _drive(self):
        self._x += 0.01
        msg = Odometry()
        msg.pose.pose.position.x = self._x
        msg.twist.twist.linear.x = self._x
        self._pub.publish(msg)


def main():
    rclpy.init()
    base_executor = SingleThreadedExecutor()
    base_executor.add_node(Base())
    threading.Thread(target=base_executor.spin, daemon=True).start()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Controller())
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
