"""Publish msg_C every second and msg_D every two seconds: the environment of the paper cases."""

import argparse
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import String


class PaperPublisher(Node):
    """One timer for each of the two topics."""

    def __init__(self) -> None:
        super().__init__('paper_publisher')
        time_scale = self.declare_parameter('time_scale', 1.0).value
        self.msg_c = self.create_publisher(String, 'msg_C', 10)
        self.msg_d = self.create_publisher(String, 'msg_D', 10)
        self.create_timer(1.0 * time_scale, self.publish_c)
        self.create_timer(2.0 * time_scale, self.publish_d)

    def publish_c(self) -> None:
        self.msg_c.publish(String(data='C'))

    def publish_d(self) -> None:
        self.msg_d.publish(String(data='D'))


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
        node = PaperPublisher()
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
