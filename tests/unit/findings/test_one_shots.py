"""Timers that cancel themselves, at once or after a wait that may be longer than their period."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Oven(Node):
    def __init__(self):
        super().__init__('oven')
        group = KIND()
        self.lit = 0
        self.client = self.create_client(Trigger, 'gas')
        self.timer = self.create_timer(0.5, self.light, callback_group=group)

    def light(self):
        BODY

    def spark(self, seconds):
        time.sleep(seconds)

rclpy.init()
executor = EXECUTOR
executor.add_node(Oven())
executor.spin()
"""
FREE = 'ReentrantCallbackGroup'
POOL = 'MultiThreadedExecutor(num_threads=3)'
LATE = 'self.spark(0.7); self.lit += 1; self.timer.cancel()'


def told(body: str, group: str = FREE, executor: str = POOL) -> list[str]:
    text = NODE.replace('BODY', body).replace('KIND', group).replace('EXECUTOR', executor)
    findings = findings_of(scan_text(text).units, [], [None])
    return [f'{f.code} {f.severity.value}' for f in findings if f.code.startswith('CC3')]


@pytest.mark.parametrize(
    ('body', 'expected'),
    [
        (LATE, ['CC304 warning']),
        ('self.spark(0.3); self.spark(0.3); self.timer.cancel()', ['CC304 warning']),
        ('self.client.wait_for_service(); self.timer.cancel()', ['CC304 note']),
        ('self.timer.cancel(); self.spark(0.7); self.lit += 1', []),
        ('self.spark(0.3); self.lit += 1; self.timer.cancel()', []),
    ],
)
def test_who_cancels_after_a_wait_may_run_again_before(body: str, expected: list[str]) -> None:
    assert told(body) == expected


def test_nothing_runs_beside_it_in_an_exclusive_group_or_on_one_thread() -> None:
    assert told(LATE, 'MutuallyExclusiveCallbackGroup') == []
    assert told(LATE, executor='SingleThreadedExecutor()') == []
