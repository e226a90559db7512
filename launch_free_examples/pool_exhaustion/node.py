"""
A dead-lock that depends on the number of threads: as many waiting callbacks as workers.

Each arm's timer calls the shared planner synchronously. Groups are right: every client may take
its answer while its timer waits. With two threads both workers wait, and nobody is left to serve
the planner; with three or more the same node works.
"""
import argparse
import os
import signal
import threading
import time

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from std_srvs.srv import Trigger


class Planner(Node):
    """Plans for 50 ms."""

    def __init__(self) -> None:
        super().__init__('planner')
        self.create_service(Trigger, 'plan', self.on_plan)

    def on_plan(
        self, request: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        time.sleep(0.05)
        response.success = True
        return response


class TwoArms(Node):
    """Lets both arms ask for a plan."""

    def __init__(self) -> None:
        super().__init__('two_arms')
        self.left = self.create_client(
            Trigger, 'plan', callback_group=MutuallyExclusiveCallbackGroup())
        self.right = self.create_client(
            Trigger, 'plan', callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(
            0.5, self.move_left, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(
            0.5, self.move_right, callback_group=MutuallyExclusiveCallbackGroup())

    def move_left(self) -> None:
        self.get_logger().info('left arm asks')
        self.left.call(Trigger.Request())
        self.get_logger().info('left arm moves')

    def move_right(self) -> None:
        self.get_logger().info('right arm asks')
        self.right.call(Trigger.Request())
        self.get_logger().info('right arm moves')


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
        executor.add_node(Planner())
        executor.add_node(TwoArms())
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
