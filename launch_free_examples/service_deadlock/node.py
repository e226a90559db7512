"""
A dead-lock: a timer calls a service synchronously, and the answer can never be taken.

Timer and client are in the node's default group. ``call`` waits inside the timer's callback for
an answer that the client may only take once that callback has ended; more threads do not help.
"""
import argparse
import os
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_srvs.srv import Trigger


class MapServer(Node):
    """Says whether there is a map."""

    def __init__(self) -> None:
        super().__init__('map_server')
        self.create_service(Trigger, 'map_ready', self.on_map_ready)

    def on_map_ready(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = True
        return response


class Navigator(Node):
    """Asks for the map before it drives."""

    def __init__(self) -> None:
        super().__init__('navigator')
        self.client = self.create_client(Trigger, 'map_ready')
        self.create_timer(0.5, self.drive)

    def drive(self) -> None:
        self.get_logger().info('asks for the map')
        self.client.call(Trigger.Request())
        self.get_logger().info('drives')


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
        executor.add_node(MapServer())
        executor.add_node(Navigator())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()
    # A worker that waits for ever would keep the interpreter from ending.
    os._exit(0)


if __name__ == '__main__':
    main()
