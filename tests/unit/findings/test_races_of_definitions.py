"""What is imported, and what sets to None: accesses that no race names."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

LOADS = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

class Grip(Node):
    def __init__(self):
        super().__init__('grip')
        self.kind = None
        side = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Empty, 'open', self.on_open, 10, callback_group=side)
        self.create_subscription(Empty, 'close', self.on_close, 10)

    def load(self):
        STORES

    def ask(self):
        return self.kind.Request().width

    def on_open(self, msg):
        self.load()
        if self.ask() is None:
            self.load()

    def on_close(self, msg):
        self.load()
        self.ask()

rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(Grip())
executor.spin()
"""
IMPORT = 'from grip_msgs.srv import Ask\n        self.kind = Ask'


@pytest.mark.parametrize(('stores', 'told'), [(IMPORT, []), ('self.kind = object()', ['CC301'])])
def test_an_import_is_the_same_whatever_was_found_before(stores: str, told: list[str]) -> None:
    units = scan_text(LOADS.replace('STORES', stores)).units
    found = findings_of(units, [], [None])
    assert [each.code for each in found if each.severity.value == 'warning'] == told


CLEARS = """\
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

class Grasp(Node):
    def __init__(self):
        super().__init__('grasp')
        self.target = None
        group = ReentrantCallbackGroup()
        self.create_subscription(Empty, 'seen', self.on_seen, 10, callback_group=group)
        self.create_subscription(Empty, 'lost', self.on_lost, 10, callback_group=group)
        self.create_timer(0.1, self.tick, callback_group=group)

    def on_seen(self, msg):
        self.target = msg

    def on_lost(self, msg):
        self.target = None

    def tick(self):
        if self.target is not None and print() is None:
            self.target.copy()
            self.target = None

rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(Grasp())
executor.spin()
"""


def test_only_who_sets_it_to_none_is_said_to() -> None:
    found = findings_of(scan_text(CLEARS).units, [], [None])
    (cleared,) = [each for each in found if each.code == 'CC305']
    assert 'and Grasp.on_lost may set it to None' in cleared.message
