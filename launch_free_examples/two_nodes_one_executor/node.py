"""
Two nodes in one multi-threaded executor, each with a default group of its own.

Callbacks of one node exclude each other; callbacks of different nodes may overlap. Both classes
call their timer callback ``on_timer``: the names must not be mixed up.
"""

import argparse
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_msgs.msg import Float64


class WheelEncoder(Node):
    """Publishes the wheel's position."""

    def __init__(self) -> None:
        super().__init__('wheel_encoder')
        self.position = 0.0
        self.publisher = self.create_publisher(Float64, 'wheel_position', 10)
        self.create_timer(0.02, self.on_timer)

    def on_timer(self) -> None:
        self.position += 0.01
        self.publisher.publish(Float64(data=self.position))


class Odometry(Node):
    """Adds the wheel's positions up and reports them."""

    def __init__(self) -> None:
        super().__init__('odometry')
        self.distance = 0.0
        self.create_subscription(Float64, 'wheel_position', self.on_position, 10)
        self.create_timer(0.5, self.on_timer)

    def on_position(self, message: Float64) -> None:
        self.distance = message.data

    def on_timer(self) -> None:
        self.get_logger().info(f'distance {self.distance:.2f} m')


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
        executor.add_node(WheelEncoder())
        executor.add_node(Odometry())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
