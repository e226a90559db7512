"""CC305: what is used in place after a call weighs as any other use."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.goal = []
        self.create_timer(0.1, self.check, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.07, self.on_stop)

    def check(self):
        if self.goal is not None:
            BETWEEN
            self.goal.append('step')
        self.goal = []

    def on_stop(self):
        self.goal = None

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Arm())
executor.spin()
"""


@pytest.mark.parametrize(
    ('between', 'severity'), [('time.sleep(0.1)', 'warning'), ('step = 1', 'note')]
)
def test_a_call_before_a_change_in_place_lets_others_in(between: str, severity: str) -> None:
    units = scan_text(PROGRAM.replace('BETWEEN', between)).units
    found = findings_of(units, [], [None] * len(units))
    told = [(each.place.line, each.severity.value) for each in found if each.code == 'CC305']
    assert told == [(17, severity)]
