"""Tests that run under many schedules; the one that counts fails under some of them."""

import threading
import time

import pytest
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

# The publisher may know of the subscription before that knows of it: nothing is lost by that.
KEPT = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.count = 0
        self.ended = []
        self.one, self.two = threading.Lock(), threading.Lock()
        for topic, callback in (
            ('left', self.on_left),
            ('right', self.on_right),
            ('up', self.on_up),
            ('down', self.on_down),
        ):
            group = MutuallyExclusiveCallbackGroup()
            self.create_subscription(String, topic, callback, KEPT, callback_group=group)

    def on_left(self, msg):
        before = self.count
        self.get_logger().debug('left')
        self.count = before + 1
        self.ended.append('left')

    def on_right(self, msg):
        before = self.count
        self.get_logger().debug('right')
        self.count = before + 1
        self.ended.append('right')

    def on_up(self, msg):
        with self.one:
            self.get_logger().debug('up')
            with self.two:
                self.ended.append('up')

    def on_down(self, msg):
        with self.two:
            self.get_logger().debug('down')
            with self.one:
                self.ended.append('down')


@pytest.fixture(scope='module')
def partner():
    rclpy.init()
    yield rclpy.create_node('partner')
    rclpy.try_shutdown()


@pytest.fixture
def counter(partner):
    node = Counter()
    yield node
    node.destroy_node()


def spin(partner, node, *topics):
    """Send a message on each topic, and spin until all are served, or for a while."""
    publishers = [partner.create_publisher(String, topic, KEPT) for topic in topics]
    executor = MultiThreadedExecutor(num_threads=4)
    executor.add_node(node)
    while not all(each.get_subscription_count() for each in publishers):
        time.sleep(0.01)
    for each in publishers:
        each.publish(String())
    until = time.monotonic() + 5.0
    while len(node.ended) < len(topics) and time.monotonic() < until:
        executor.spin_once(timeout_sec=0.1)
    for each in publishers:
        partner.destroy_publisher(each)


@pytest.mark.ros2cc_schedules(40)
def test_both_count(partner, counter):
    spin(partner, counter, 'left', 'right')
    assert counter.count == 2


@pytest.mark.ros2cc_schedules(3)
def test_one_counts(partner, counter):
    spin(partner, counter, 'left')
    assert counter.count == 1


@pytest.mark.ros2cc_schedules(3)
def test_spin_once_serves_a_timer(partner, counter):
    """Who asks but once is not refused."""
    served = []
    counter.create_timer(0.01, lambda: served.append(1))
    rclpy.spin_once(counter, timeout_sec=5)
    assert served


@pytest.mark.ros2cc_schedules(40)
def test_locks(partner, counter):
    spin(partner, counter, 'up', 'down')
    until = time.monotonic() + 20
    while len(counter.ended) < 2 and time.monotonic() < until:
        time.sleep(0.05)


def test_without_a_marker(counter):
    assert counter.count == 0
