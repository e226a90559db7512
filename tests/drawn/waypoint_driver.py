import math
import threading
import time

import rclpy
from geometry_msgs.msg import Point, PoseArray
from rclpy.action import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci


class WaypointFollower(Node):
    """Follows a list of waypoints that the planner may replace at any time."""

    SPEED = 2.0

    def __init__(self):
        super().__init__('waypoint_follower')
        self._route_group = MutuallyExclusiveCallbackGroup()
        self._lock = threading.Lock()
        self._busy = False
        self._route = []
        self._position = (0.0, 0.0)
        self._reached_pub = self.create_publisher(Point, 'waypoint_reached', 20)
        self.create_subscription(
            PoseArray, 'route', self.on_route, 10, callback_group=self._route_group)
        self._server = ActionServer(
            self, Fibonacci, 'follow_route', self.execute,
            goal_callback=self.on_goal,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=self._route_group)

    def on_goal(self, goal):
        with self._lock:
            if self._busy:
                return GoalResponse.REJECT
            self._busy = True
            return GoalResponse.ACCEPT

    def on_route(self, msg):
        route = [(pose.position.x, pose.position.y) for pose in msg.poses]
        self._route = route
        self.get_logger().info(f'new route with {len(route)} waypoints')

    def execute(self, goal_handle):
        try:
            return self._follow(goal_handle)
        finally:
            with self._lock:
                self._busy = False

    def _follow(self, goal_handle):
        reached = 0
        while self._route:
            target = self._route[0]
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                break
            self._drive_to(target)
            self._route.pop(0)
            reached += 1
            self._reached_pub.publish(Point(x=target[0], y=target[1]))
            goal_handle.publish_feedback(Fibonacci.Feedback(sequence=[reached]))
        else:
            goal_handle.succeed()
        return Fibonacci.Result(sequence=[reached])

    def _drive_to(self, target):
        """Open-loop drive with constant speed."""
        distance = math.dist(self._position, target)
        time.sleep(distance / self.SPEED)
        self._position = target


def main():
    rclpy.init()
    node = WaypointFollower()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(node)
    try:
        executor.spin()
    except KeyboardInterrupt:
        pass


if __name__ == '__main__':
    main()
