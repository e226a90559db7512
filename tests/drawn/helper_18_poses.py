"""Shared base for nodes that follow the robot's pose."""
import threading
from typing import Tuple

from nav_msgs.msg import Odometry
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node

Point2 = Tuple[float, float]


class PoseTracker(Node):
    """Keeps the newest position and tells subclasses about it."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self._pose_lock = threading.Lock()
        self._position: Point2 = (0.0, 0.0)
        self._distance = 0.0
        self.create_subscription(
            Odometry, 'odom', self._on_odom, 10,
            callback_group=MutuallyExclusiveCallbackGroup())

    def position(self) -> Point2:
        with self._pose_lock:
            return self._position

    def _on_odom(self, msg: Odometry) -> None:
        p = msg.pose.pose.position
        with self._pose_lock:
            x, y = self._position
            self._distance += abs(p.x - x) + abs(p.y - y)
            self._position = (p.x, p.y)
            self.moved(self._position)

    def moved(self, position: Point2) -> None:
        """Hook for subclasses, called for each new position."""
