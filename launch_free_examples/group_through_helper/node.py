"""
A group handed to a helper class, which creates the entities on the node it is given.

The helper is no node: its timer and subscription belong to the node, in the group that the node
chose. A second helper is given no group, so its entities go to the node's default group.
"""

import argparse
import signal
import threading

import rclpy
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import Empty


class HeartbeatMonitor:
    """Warns when a heartbeat stays away."""

    def __init__(self, node: Node, topic: str, group: CallbackGroup | None = None) -> None:
        self.node = node
        self.topic = topic
        self.beats = 0
        node.create_subscription(Empty, topic, self.on_beat, 10, callback_group=group)
        node.create_timer(1.0, self.check, callback_group=group)

    def on_beat(self, message: Empty) -> None:
        self.beats += 1

    def check(self) -> None:
        if self.beats == 0:
            self.node.get_logger().warn(f'no heartbeat on {self.topic}')
        self.beats = 0


class Supervisor(Node):
    """Watches the base and the arm."""

    def __init__(self) -> None:
        super().__init__('supervisor')
        self.group = ReentrantCallbackGroup()
        self.base = HeartbeatMonitor(self, 'base/heartbeat', self.group)
        self.arm = HeartbeatMonitor(self, 'arm/heartbeat')


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
        executor.add_node(Supervisor())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
