import threading

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from test_msgs.action import Fibonacci


class Navigator:
    """Send a goal and give back its final status."""

    def __init__(self, node, action_name, callback_group=None):
        self._node = node
        self._client = ActionClient(
            node, Fibonacci, action_name, callback_group=callback_group)
        self._finished = threading.Event()
        self._status = GoalStatus.STATUS_UNKNOWN

    def go(self, waypoints):
        self._finished.clear()
        self._client.wait_for_server()
        goal = Fibonacci.Goal()
        goal.order = waypoints
        sent = self._client.send_goal_async(goal, feedback_callback=self._on_feedback)
        sent.add_done_callback(self._on_response)
        self._finished.wait()
        return self._status

    def _on_feedback(self, message):
        done = len(message.feedback.sequence)
        self._node.get_logger().info('reached %d waypoints' % done)

    def _on_response(self, future):
        handle = future.result()
        if not handle.accepted:
            self._status = GoalStatus.STATUS_ABORTED
            self._finished.set()
            return
        handle.get_result_async().add_done_callback(self._on_result)

    def _on_result(self, future):
        self._status = future.result().status
        self._finished.set()
