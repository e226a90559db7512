"""
A setting without effect: the multi-threaded executor is filled, but another one is spun.

``rclpy.spin(node)`` takes the node out of its executor and puts it into the global
single-threaded one. The camera therefore waits for the slow upload, no matter what the groups say.
"""

import argparse
import signal
import threading
import time

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import Header


class CameraUpload(Node):
    """Notes image headers and uploads the last one now and then."""

    def __init__(self) -> None:
        super().__init__('camera_upload')
        self.last = Header()
        self.group = ReentrantCallbackGroup()
        self.create_subscription(
            Header, 'image_header', self.on_header, 10, callback_group=self.group
        )
        self.create_timer(1.0, self.upload, callback_group=self.group)

    def on_header(self, message: Header) -> None:
        self.last = message

    def upload(self) -> None:
        time.sleep(0.3)
        self.get_logger().info(f'uploaded frame {self.last.frame_id or "none"}')


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
        node = CameraUpload()
        executor = MultiThreadedExecutor(num_threads=4)
        executor.add_node(node)
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
