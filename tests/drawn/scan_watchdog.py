"""Obstacle detector with a command watchdog, built on the in-house node base."""
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class ComponentBase(Node):
    """Keeps the entities of a component together for introspection."""

    def __init__(self, name):
        super().__init__(name)
        self.inputs = {}
        self.outputs = {}
        self.jobs = []

    def add_input(self, topic, msg_type, callback, depth=10, group=None):
        sub = self.create_subscription(msg_type, topic, callback, depth)
        self.inputs[topic] = sub
        return sub

    def add_output(self, topic, msg_type, depth=10):
        self.outputs[topic] = self.create_publisher(msg_type, topic, depth)
        return self.outputs[topic]

    def add_job(self, period, callback, group=None):
        timer = self.create_timer(period, callback, callback_group=group)
        self.jobs.append(timer)
        return timer


class ObstacleDetector(ComponentBase):
    PERIOD = 0.1

    def __init__(self):
        super().__init__('obstacle_detector')
        self.scan_group = MutuallyExclusiveCallbackGroup()
        self.stop_pub = self.add_output('cmd_vel', Twist)
        self.add_input('scan', LaserScan, self.on_scan, depth=1, group=self.scan_group)
        self.add_job(self.PERIOD, self.on_watchdog)
        self.last_tick = time.monotonic()
        self.worst = 0.0
        self.clusters = 0
        self.add_job(2.0, self.on_report)

    def on_scan(self, msg):
        self.clusters = self.segment(msg.ranges)

    def segment(self, ranges):
        time.sleep(0.9)
        return sum(1 for r in ranges if r < 1.0)

    def on_watchdog(self):
        now = time.monotonic()
        late = now - self.last_tick - self.PERIOD
        self.last_tick = now
        self.worst = max(self.worst, late)
        if late > 0.5:
            self.get_logger().error(f'watchdog {late:.2f} s late')
        self.stop_pub.publish(Twist())

    def on_report(self):
        self.get_logger().info(f'worst lateness {self.worst:.2f} s, {self.clusters} clusters')


class ScanSource(Node):
    def __init__(self):
        super().__init__('scan_source')
        self.pub = self.create_publisher(LaserScan, 'scan', 1)
        self.create_timer(0.2, self.on_timer)

    def on_timer(self):
        self.pub.publish(LaserScan(ranges=[0.5, 2.0, 0.7]))


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    detector, source = ObstacleDetector(), ScanSource()
    executor.add_node(detector)
    executor.add_node(source)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
