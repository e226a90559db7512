"""Coverage run of a cleaning robot as an action; one run at a time, may be cancelled."""
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient, ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class CoverageServer(Node):

    def __init__(self):
        super().__init__('coverage_server')
        self._lock = threading.Lock()
        self._lane = 0
        self._server = ActionServer(
            self, Fibonacci, 'cover',
            execute_callback=self._execute,
            goal_callback=self._on_goal,
            cancel_callback=self._on_cancel,
            callback_group=ReentrantCallbackGroup())

    def _on_goal(self, goal_request):
        return GoalResponse.ACCEPT if 0 < goal_request.order < 100 else GoalResponse.REJECT

    def _on_cancel(self, goal_handle):
        with self._lock:
            near_end = self._lane >= goal_handle.request.order - 1
        return CancelResponse.REJECT if near_end else CancelResponse.ACCEPT

    def _execute(self, goal_handle):
        feedback = Fibonacci.Feedback()
        result = Fibonacci.Result()
        with self._lock:
            self._lane = 0
            while self._lane < goal_handle.request.order:
                if goal_handle.is_cancel_requested:
                    goal_handle.canceled()
                    result.sequence = feedback.sequence
                    return result
                self._drive_lane()
                self._lane += 1
                feedback.sequence = list(range(self._lane))
                goal_handle.publish_feedback(feedback)
        goal_handle.succeed()
        result.sequence = feedback.sequence
        return result

    def _drive_lane(self):
        time.sleep(0.4)


class Dispatcher(Node):

    def __init__(self):
        super().__init__('dispatcher')
        self._client = ActionClient(self, Fibonacci, 'cover')
        self._handle = None
        self._asked = 0.0
        self._timer = self.create_timer(0.5, self._begin)
        self._stopper = None

    def _begin(self):
        if not self._client.server_is_ready():
            return
        self._timer.cancel()
        self._client.send_goal_async(Fibonacci.Goal(order=10)).add_done_callback(self._on_accept)

    def _on_accept(self, future):
        self._handle = future.result()
        self._handle.get_result_async().add_done_callback(self._on_result)
        self._stopper = self.create_timer(1.0, self._stop)

    def _stop(self):
        self._stopper.cancel()
        self._asked = time.monotonic()
        self.get_logger().info('stop the coverage run')
        self._handle.cancel_goal_async().add_done_callback(self._on_cancelled)

    def _on_cancelled(self, future):
        self.get_logger().info(
            f'cancel answered after {time.monotonic() - self._asked:.2f} s, '
            f'{len(future.result().goals_canceling)} goals cancelling')

    def _on_result(self, future):
        reply = future.result()
        word = 'cancelled' if reply.status == GoalStatus.STATUS_CANCELED else 'finished'
        self.get_logger().info(f'{word} with {len(reply.result.sequence)} lanes')


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=4)
    for node in (CoverageServer(), Dispatcher()):
        executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
