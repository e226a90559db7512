"""
Obstacle stop: slow planning in one group must not delay the stop of another.

The laser scan and the plan timer are in two mutually exclusive groups on two threads, so a scan
is handled while a plan is computed. Both touch ``blocked``, which therefore needs a lock.
"""

import argparse
import signal
import threading
import time

import rclpy
from geometry_msgs.msg import Twist
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.signals import uninstall_signal_handlers
from sensor_msgs.msg import LaserScan

STOP_DISTANCE_M = 0.4


class ObstacleStop(Node):
    """Drives ahead, stops in front of obstacles."""

    def __init__(self) -> None:
        super().__init__('obstacle_stop')
        self.blocked = False
        self.lock = threading.Lock()
        self.safety_group = MutuallyExclusiveCallbackGroup()
        self.planning_group = MutuallyExclusiveCallbackGroup()
        self.command = self.create_publisher(Twist, 'cmd_vel', 10)
        self.create_subscription(
            LaserScan,
            'scan',
            self.on_scan,
            qos_profile_sensor_data,
            callback_group=self.safety_group,
        )
        self.create_timer(0.05, self.drive, callback_group=self.safety_group)
        self.create_timer(0.5, self.plan, callback_group=self.planning_group)

    def on_scan(self, scan: LaserScan) -> None:
        with self.lock:
            self.blocked = min(scan.ranges, default=scan.range_max) < STOP_DISTANCE_M

    def drive(self) -> None:
        command = Twist()
        with self.lock:
            command.linear.x = 0.0 if self.blocked else 0.2
        self.command.publish(command)

    def plan(self) -> None:
        with self.lock:
            blocked = self.blocked
        time.sleep(0.2)
        self.get_logger().info('planned around it' if blocked else 'planned ahead')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, help='stop after this time')
    options, ros_arguments = parser.parse_known_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    rclpy.init(args=ros_arguments)
    if options.seconds is not None:
        limit = threading.Timer(options.seconds, signal.raise_signal, [signal.SIGINT])
        limit.daemon = True
        limit.start()
    try:
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(ObstacleStop())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
