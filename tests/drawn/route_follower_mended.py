"""Follows a list of way points and publishes the current one."""
import math
import threading
from typing import List

import rclpy
from geometry_msgs.msg import PoseArray, PointStamped
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from std_msgs.msg import Float32

from helper_18_poses import Point2, PoseTracker


class RouteFollower(PoseTracker):

    def __init__(self) -> None:
        super().__init__('route_follower')
        self._route_lock = threading.Lock()
        self._route: List[Point2] = [(0.02 * i, 0.01 * i) for i in range(3000)]
        self._index = 0
        self._radius = self.declare_parameter('radius', 0.2).value
        self._target_pub = self.create_publisher(PointStamped, 'target', 10)
        self._left_pub = self.create_publisher(Float32, 'distance_left', 10)
        group = MutuallyExclusiveCallbackGroup()
        self.create_subscription(
            PoseArray, 'route', self._on_route, 1, callback_group=group)
        self.create_timer(0.05, self._on_tick, callback_group=group)

    def moved(self, position: Point2) -> None:
        with self._route_lock:
            if self._index >= len(self._route):
                return
            if self._gap(position, self._route[self._index]) < self._radius:
                self._index += 1

    def _on_route(self, msg: PoseArray) -> None:
        points = [(p.position.x, p.position.y) for p in msg.poses]
        with self._route_lock:
            self._route = points
            self._index = 0

    def _on_tick(self) -> None:
        here = self.position()
        with self._route_lock:
            if self._index >= len(self._route):
                return
            target = self._route[self._index]
            left = self._rest_of_route() + self._gap(here, target)
        self._publish(target, left)

    def _rest_of_route(self) -> float:
        rest = self._route[self._index:]
        return sum(self._gap(a, b) for a, b in zip(rest, rest[1:]))

    def _publish(self, target: Point2, left: float) -> None:
        msg = PointStamped()
        msg.header.stamp = self.get_clock().now().to_msg()
        msg.header.frame_id = 'odom'
        msg.point.x, msg.point.y = target
        self._target_pub.publish(msg)
        self._left_pub.publish(Float32(data=left))

    @staticmethod
    def _gap(a: Point2, b: Point2) -> float:
        return math.hypot(a[0] - b[0], a[1] - b[1])


def main() -> None:
    rclpy.init()
    node = RouteFollower()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
