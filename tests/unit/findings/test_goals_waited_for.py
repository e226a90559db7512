"""Callbacks of an action server that wait until a goal has been executed."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """
import threading
import time
import rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from test_msgs.action import Fibonacci

class Press(Node):
    def __init__(self):
        super().__init__('press')
        self.over = threading.Event()
        self.halt = threading.Event()
        self.stopped = False
        self.goal = None
        self.server = ActionServer(
            self, Fibonacci, 'press', self.execute, handle_accepted_callback=self.accepted,
            callback_group=KIND())

    def accepted(self, goal_handle):
        ACCEPTED
        goal_handle.execute()

    def execute(self, goal_handle):
        for _ in range(goal_handle.request.order):
            if self.stopped or self.halt.wait(0.2):
                break
        self.over.set()
        return Fibonacci.Result()

rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Press())
executor.spin()
"""
OWN = 'MutuallyExclusiveCallbackGroup'


@pytest.mark.parametrize(
    ('accepted', 'group', 'codes'),
    [
        ('self.over.wait()', OWN, ['CC203']),
        ('self.over.wait()', 'ReentrantCallbackGroup', []),
        ('self.over.wait(0.1)', OWN, []),
        ('pass', OWN, []),
        # Code that stops the goal waits only until that has noticed.
        ('self.halt.set(); self.over.wait()', OWN, []),
        ('self.stopped = True; self.over.wait()', OWN, []),
        ('self.goal.abort(); self.over.wait()', OWN, []),
    ],
)
def test_who_waits_for_a_goal_holds_up_its_cancel(
    accepted: str, group: str, codes: list[str]
) -> None:
    text = NODE.replace('ACCEPTED', accepted).replace('KIND', group)
    findings = findings_of(scan_text(text).units, [], [None])
    assert [f.code for f in findings if f.code == 'CC203'] == codes
