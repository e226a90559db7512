"""Pose relay: a receiver thread fills the pose, a timer sends it on."""

import math
import threading
import time
from typing import NamedTuple

import rclpy
from geometry_msgs.msg import Pose2D
from rclpy.node import Node


class Reading(NamedTuple):
    """One pose as it came."""

    x: float
    y: float
    theta: float


class Tracker:
    """A tracker's own thread: a pose every few microseconds."""

    def __init__(self):
        self._latest = Reading(0.0, 0.0, 0.0)
        self._running = True
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self):
        self._thread.start()

    def stop(self):
        self._running = False
        self._thread.join(timeout=1.0)

    @property
    def pose(self):
        return self._latest

    @pose.setter
    def pose(self, value):
        self._latest = Reading(value, -value, self._wrap(value))

    @staticmethod
    def _wrap(angle):
        turned = angle
        while turned >= 700.0:
            turned -= 700.0
        return math.fmod(turned, 7.0)

    def _run(self):
        step = 0.0
        while self._running:
            step += 100.0
            self.pose = step
            time.sleep(0.00001)


class PoseRelay(Node):
    """Sends the tracker's pose at fifty hertz."""

    def __init__(self, tracker):
        super().__init__('pose_relay')
        self.tracker = tracker
        self.sent = 0
        self.torn = 0
        self.pub = self.create_publisher(Pose2D, 'pose', 10)
        self.create_timer(0.001, self.relay)

    def relay(self):
        x, y, theta = self.tracker.pose
        if x != -y or theta != math.fmod(x, 7.0):
            self.torn += 1
        self.pub.publish(Pose2D(x=x, y=y, theta=theta))
        self.sent += 1


def main():
    rclpy.init()
    tracker = Tracker()
    node = PoseRelay(tracker)
    tracker.start()
    try:
        rclpy.spin(node)
    finally:
        tracker.stop()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
