"""
Stands in for ``nav2_simple_commander.robot_navigator``, with what matters for waiting.

The navigator is a node of its own. Its methods wait for a server, send a goal or a request, and
spin this node with the global executor until the answer is there. Source:
ros-navigation/navigation2 0012804e, ``nav2_simple_commander/robot_navigator.py``. One action and
one service stand for all.

Runs inside the user's process: the standard library and rclpy only.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from enum import Enum
from typing import Any

_Node: Any = importlib.import_module('rclpy.node').Node
_SUCCEEDED, _CANCELED, _ABORTED = 4, 5, 6
_LOOKS_S = 0.1


class TaskResult(Enum):
    """How a task has ended."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


class BasicNavigator(_Node):  # type: ignore[misc]
    """Every task is a goal, every question about the map a request."""

    def __init__(self, node_name: str = 'basic_navigator', namespace: str = '') -> None:
        super().__init__(node_name=node_name, namespace=namespace)
        actions, services = map(importlib.import_module, ('nav2_msgs.action', 'nav2_msgs.srv'))
        client = importlib.import_module('rclpy.action').ActionClient
        self._goal, self._request = actions.NavigateToPose.Goal, services.LoadMap.Request
        self.nav_to_pose_client = client(self, actions.NavigateToPose, 'navigate_to_pose')
        self.change_maps_srv = self.create_client(services.LoadMap, 'map_server/load_map')
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None

    def isTaskComplete(self, *_: Any, **__: Any) -> bool:  # noqa: N802
        """Look for a moment whether the result is there."""
        if not self.result_future:
            return True
        self._spin(self.result_future, _LOOKS_S)
        if not self.result_future.done():
            return False
        self.status = self.result_future.result().status
        return True

    def cancelTask(self) -> None:  # noqa: N802
        """Wait until the server has taken note."""
        if self.result_future:
            self._spin(self.goal_handle.cancel_goal_async())

    def getFeedback(self, *_: Any, **__: Any) -> Any:  # noqa: N802
        """Give the last message about a task."""
        return self.feedback

    def getResult(self) -> TaskResult:  # noqa: N802
        """Say how the last task has ended."""
        known = {
            _SUCCEEDED: TaskResult.SUCCEEDED,
            _CANCELED: TaskResult.CANCELED,
            _ABORTED: TaskResult.FAILED,
        }
        return known.get(self.status or 0, TaskResult.UNKNOWN)

    def setInitialPose(self, initial_pose: Any) -> None:  # noqa: N802
        """Publish where the robot is; nobody waits."""

    def destroyNode(self) -> None:  # noqa: N802
        """Destroy the node under its other name."""
        self.destroy_node()

    def info(self, text: str) -> None:
        """Log it."""
        self.get_logger().info(text)

    def warn(self, text: str) -> None:
        """Log it."""
        self.get_logger().warn(text)

    def error(self, text: str) -> None:
        """Log it."""
        self.get_logger().error(text)

    def debug(self, text: str) -> None:
        """Log it."""
        self.get_logger().debug(text)

    def _send(self) -> bool:
        while not self.nav_to_pose_client.wait_for_server(timeout_sec=1.0):
            self.info('the server is not there, waiting')
        sent = self.nav_to_pose_client.send_goal_async(self._goal(), self._keep_feedback)
        self._spin(sent)
        self.goal_handle = sent.result()
        if not self.goal_handle.accepted:
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def _keep_feedback(self, message: Any) -> None:
        self.feedback = message.feedback

    def _ask(self) -> Any:
        while not self.change_maps_srv.wait_for_service(timeout_sec=1.0):
            self.info('the service is not there, waiting')
        answer = self.change_maps_srv.call_async(self._request())
        self._spin(answer)
        return answer.result().map

    def _spin(self, future: Any, seconds: float | None = None) -> None:
        rclpy = importlib.import_module('rclpy')
        rclpy.spin_until_future_complete(self, future, timeout_sec=seconds)


def _starts(self: BasicNavigator, *_: Any, **__: Any) -> bool:
    """Send a goal, and wait until it is accepted."""
    return self._send()


def _finds(self: BasicNavigator, *_: Any, **__: Any) -> Any:
    """Send a goal, and wait for its result."""
    if not self._send():
        return None
    self._spin(self.result_future)
    self.status = self.result_future.result().status
    return self.result_future.result().result.path


def _asks(self: BasicNavigator, *_: Any, **__: Any) -> Any:
    """Send a request, and wait for its answer."""
    return self._ask()


_METHODS: dict[Callable[..., Any], str] = {
    _starts: 'goToPose goThroughPoses followWaypoints followGpsWaypoints followPath spin backup '
    'assistedTeleop driveOnHeading dockRobotByPose dockRobotByID undockRobot',
    _finds: 'getPath getPathThroughPoses smoothPath',
    _asks: 'changeMap clearAllCostmaps clearLocalCostmap clearGlobalCostmap '
    'clearCostmapExceptRegion clearCostmapAroundRobot getGlobalCostmap getLocalCostmap '
    'lifecycleStartup lifecycleShutdown waitUntilNav2Active',
}
for _does, _names in _METHODS.items():
    for _name in _names.split():
        setattr(BasicNavigator, _name, _does)
