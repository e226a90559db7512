"""
One subscription per robot, made in a loop, each with a lambda and a group of its own.

Messages of two robots may be handled at the same time, two messages of one robot may not. The
summary timer stays in the node's default group.
"""

import argparse
import signal
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import String

ROBOTS = ('alpha', 'beta', 'gamma')


class FleetStatus(Node):
    """Keeps the last status of every robot."""

    def __init__(self) -> None:
        super().__init__('fleet_status')
        self.status = dict.fromkeys(ROBOTS, 'unknown')
        for robot in ROBOTS:
            self.create_subscription(
                String,
                f'{robot}/status',
                lambda message, name=robot: self.note(name, message),
                10,
                callback_group=MutuallyExclusiveCallbackGroup(),
            )
        self.create_timer(1.0, self.summarise)

    def note(self, robot: str, message: String) -> None:
        self.status[robot] = message.data

    def summarise(self) -> None:
        text = ', '.join(f'{robot} {status}' for robot, status in self.status.items())
        self.get_logger().info(text)


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
        executor = MultiThreadedExecutor(num_threads=4)
        executor.add_node(FleetStatus())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
