"""What a callback stores before it asks for a done-callback that it then waits for."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of_unit

PROGRAM = """\
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Saver(Node):
    def __init__(self):
        super().__init__('saver')
        free = ReentrantCallbackGroup()
        self.client = self.create_client(Trigger, 'save', callback_group=free)
        self.saved = False
        self.create_timer(0.5, self.save)

    def save(self):
        self.saved = False
        self.client.call_async(Trigger.Request()).add_done_callback(self.on_saved)
        while not self.saved:
            time.sleep(0.02)
        self.saved = None

    def on_saved(self, future):
        self.saved = True


rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Saver())
executor.spin()
"""


def races(program: str) -> list[str]:
    (unit,) = scan_text(program).units
    codes = (finding.code for finding in findings_of_unit(unit, None))
    return [code for code in codes if code.startswith('CC30')]


def test_none_is_under_way_before_it_is_asked_for_or_when_it_was_waited_for() -> None:
    assert races(PROGRAM) == []


@pytest.mark.parametrize(
    ('text', 'other'),
    [
        ('while not self.saved', 'if not self.saved'),
        ('self.create_timer(0.5, self.save)', 'self.create_timer(0.5, self.save, free)'),
        ('while not self.saved:', 'self.saved = 0\n        while not self.saved:'),
    ],
    ids=['it does not wait', 'it overlaps itself', 'it stores in between'],
)
def test_else_both_may_store_at_once(text: str, other: str) -> None:
    assert text in PROGRAM
    assert races(PROGRAM.replace(text, other)) == ['CC302']
