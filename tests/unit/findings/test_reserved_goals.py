"""A goal that is reserved by one attribute, until another one says that it runs."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import rclpy
from rclpy.action import ActionServer, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty
from test_msgs.action import Fibonacci

class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        self.lock = threading.Lock()
        self.going = None
        self.next = None
        group = ReentrantCallbackGroup()
        ActionServer(self, Fibonacci, 'go', self.execute, goal_callback=self.on_goal,
                     callback_group=group)
        self.create_subscription(Empty, 'calm', self.on_calm, 10, callback_group=group)

    def on_goal(self, goal):
        with self.lock:
            if self.going is not None or self.next is not None:
                return GoalResponse.REJECT
            RESERVES
        return GoalResponse.ACCEPT

    def execute(self, handle):
        with self.lock:
            GIVES_BACK
            self.going = handle
        handle.succeed()
        with self.lock:
            self.going = None
            self.next = None
        return Fibonacci.Result()

    def on_calm(self, msg):
        CALMS

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Lift())
executor.spin()
"""
ONE_HOLD = 'self.next = None'
TWO_HOLDS = 'self.next = None\n        with self.lock:'


def late(reserves: str, gives_back: str, calms: str) -> list[str]:
    text = PROGRAM.replace('RESERVES', reserves).replace('GIVES_BACK', gives_back)
    findings = findings_of(scan_text(text.replace('CALMS', calms)).units, [], [None])
    return [each.code for each in findings if 'both may be accepted' in each.message]


@pytest.mark.parametrize('gives_back', [ONE_HOLD, 'pass'])
def test_a_reservation_that_is_handed_over_under_one_lock_keeps_goals_out(gives_back: str) -> None:
    assert late('self.next = goal', gives_back, 'pass') == []


@pytest.mark.parametrize(
    ('reserves', 'gives_back', 'calms'),
    [
        ('pass', ONE_HOLD, 'pass'),
        ('self.next = goal', TWO_HOLDS, 'pass'),
        ('self.next = goal', ONE_HOLD, 'self.next = None'),
    ],
)
def test_none_is_there_or_it_is_given_up_too_early(
    reserves: str, gives_back: str, calms: str
) -> None:
    assert late(reserves, gives_back, calms) == ['CC303']
