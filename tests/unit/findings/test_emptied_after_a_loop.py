"""CC301: a callback goes over a list and then empties it, and another one puts something in."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import rclpy
from geometry_msgs.msg import PoseStamped
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Float32


class Batch(Node):
    def __init__(self):
        super().__init__('batch')
        self.items, self.total, self.goal, self.x = [], 0.0, None, 0.0
        self.lock = threading.Lock()
        other = MutuallyExclusiveCallbackGroup()
        self.create_subscription(Float32, 'item', self.on_item, 10, callback_group=other)
        self.create_subscription(PoseStamped, 'goal', self.on_goal, 1, callback_group=other)
        self.create_timer(0.1, self.flush)

    def on_item(self, msg):
        {adds}
        self.goal = None

    def on_goal(self, msg):
        self.goal = msg

    def flush(self):
        {flushes}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Batch())
executor.spin()
"""
ADDS = 'self.items.append(msg.data)'
LOOP = 'for item in self.items:\n            print(item)\n        '
LOCKED = """with self.lock:
            for item in self.items:
                print(item)
            self.items.clear()"""
SWAPPED = """items, self.items = self.items, []
        for item in items:
            print(item)"""


def told(code: str, adds: str, flushes: str) -> list[int]:
    units = scan_text(PROGRAM.format(adds=adds, flushes=flushes)).units
    found = findings_of(units, [], [None] * len(units))
    return [each.place.line for each in found if each.code == code]


@pytest.mark.parametrize('empties', ['self.items.clear()', 'self.items = []'])
def test_what_comes_in_between_is_lost(empties: str) -> None:
    assert told('CC301', ADDS, LOOP + empties) == [30]


@pytest.mark.parametrize(
    ('adds', 'flushes'),
    [
        (f'with self.lock: {ADDS}', LOCKED),
        (ADDS, SWAPPED),
        (ADDS, 'self.items.clear()'),
        ('print(self.items)', LOOP + 'self.items.clear()'),
    ],
)
def test_nothing_is_lost(adds: str, flushes: str) -> None:
    assert told('CC301', adds, flushes) == []


@pytest.mark.parametrize(
    ('flushes', 'lines'),
    [
        ('print(self.goal.pose if self.goal is not None else self.x)', [28]),
        ('goal = self.goal if self.goal is not None else None\n        print(goal)', []),
        ('print(self.x if self.goal is not None else 0.0)', []),
    ],
)
def test_a_conditional_expression_tests_like_a_statement(flushes: str, lines: list[int]) -> None:
    assert told('CC305', ADDS, flushes) == lines
