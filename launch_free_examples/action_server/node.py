"""
An action server that can be cancelled while it works, and a status timer next to it.

Goal and cancel requests are handled in the server's reentrant group. The execute callback runs as
a task of the executor, outside every group: on one thread a cancel would come too late.
"""

import argparse
import signal
import threading
import time

import rclpy
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.signals import uninstall_signal_handlers
from test_msgs.action import Fibonacci


class FibonacciServer(Node):
    """Computes the sequence, one number every ``step_s`` seconds."""

    def __init__(self) -> None:
        super().__init__('fibonacci_server')
        self.step_s = self.declare_parameter('step_s', 0.5).value
        self.goals_done = 0
        self.server = ActionServer(
            self,
            Fibonacci,
            'fibonacci',
            execute_callback=self.execute,
            goal_callback=self.on_goal,
            cancel_callback=self.on_cancel,
            callback_group=ReentrantCallbackGroup(),
        )
        self.create_timer(1.0, self.report)

    def on_goal(self, goal: Fibonacci.Goal) -> GoalResponse:
        return GoalResponse.ACCEPT if goal.order >= 0 else GoalResponse.REJECT

    def on_cancel(self, goal_handle: ServerGoalHandle) -> CancelResponse:
        return CancelResponse.ACCEPT

    def execute(self, goal_handle: ServerGoalHandle) -> Fibonacci.Result:
        sequence = [0, 1]
        while len(sequence) < goal_handle.request.order:
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(self.step_s)
        self.goals_done += 1
        goal_handle.succeed()
        return Fibonacci.Result(sequence=sequence)

    def report(self) -> None:
        self.get_logger().info(f'{self.goals_done} goals done')


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
        executor.add_node(FibonacciServer())
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        uninstall_signal_handlers()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
