"""
A service and a client that never blocks: asynchronous call, answer in a done-callback.

Server and client live in two nodes on one thread. The timer only sends the request and returns,
so the same thread is free to serve it and to take the answer.
"""

import argparse
import signal
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from rclpy.task import Future
from std_srvs.srv import SetBool


class Gripper(Node):
    """Opens and closes on request."""

    def __init__(self) -> None:
        super().__init__('gripper')
        self.closed = False
        self.create_service(SetBool, 'gripper/close', self.on_close)

    def on_close(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self.closed = request.data
        response.success = True
        response.message = 'closed' if self.closed else 'open'
        return response


class Sorter(Node):
    """Opens and closes the gripper in turns."""

    def __init__(self) -> None:
        super().__init__('sorter')
        self.close_next = True
        self.client = self.create_client(SetBool, 'gripper/close')
        self.create_timer(0.2, self.toggle)

    def toggle(self) -> None:
        if not self.client.service_is_ready():
            return
        future = self.client.call_async(SetBool.Request(data=self.close_next))
        future.add_done_callback(self.on_answer)
        self.close_next = not self.close_next

    def on_answer(self, future: Future) -> None:
        self.get_logger().info(f'gripper is {future.result().message}')


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
        executor = SingleThreadedExecutor()
        executor.add_node(Gripper())
        executor.add_node(Sorter())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
