"""
Case 1 of the paper: one thread.

Two timers fire every second. The subscription to msg_C works for one second a message, the one
to msg_D for two. One thread serves all that is ready, in turns.
"""

import argparse
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import String

PUBLISHER = Path(__file__).resolve().parents[1] / 'paper_publisher' / 'node.py'


class PaperCase1(Node):
    """Two timers and two subscriptions in the node's default group."""

    def __init__(self) -> None:
        super().__init__('paper_case1')
        self.time_scale = self.declare_parameter('time_scale', 1.0).value
        self.create_timer(1.0 * self.time_scale, self.on_timer_a)
        self.create_timer(1.0 * self.time_scale, self.on_timer_b)
        self.create_subscription(String, 'msg_C', self.on_msg_c, 10)
        self.create_subscription(String, 'msg_D', self.on_msg_d, 10)

    def on_timer_a(self) -> None:
        self.get_logger().info('timer A')

    def on_timer_b(self) -> None:
        self.get_logger().info('timer B')

    def on_msg_c(self, message: String) -> None:
        self.get_logger().info('msg_C begins')
        time.sleep(1.0 * self.time_scale)
        self.get_logger().info('msg_C ends')

    def on_msg_d(self, message: String) -> None:
        self.get_logger().info('msg_D begins')
        time.sleep(2.0 * self.time_scale)
        self.get_logger().info('msg_D ends')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, help='stop after this time')
    parser.add_argument(
        '--with-publisher',
        action='store_true',
        help='start the publisher of msg_C and msg_D as a child process',
    )
    options, ros_arguments = parser.parse_known_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    rclpy.init(args=ros_arguments)
    if options.seconds is not None:
        limit = threading.Timer(options.seconds, signal.raise_signal, [signal.SIGINT])
        limit.daemon = True
        limit.start()
    publisher = None
    if options.with_publisher:
        publisher = subprocess.Popen([sys.executable, PUBLISHER, *ros_arguments])
    try:
        rclpy.spin(PaperCase1())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()
        if publisher is not None:
            publisher.terminate()
            publisher.wait()


if __name__ == '__main__':
    main()
