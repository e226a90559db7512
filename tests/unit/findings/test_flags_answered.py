"""A flag that callbacks put up where it is down, and one thread puts down where it is up."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import threading
import time
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

class Ship(Node):
    def __init__(self):
        super().__init__('ship')
        self.asked = False
        self.busy = False
        self.create_timer(0.1, self.tick, callback_group=None)
        threading.Thread(target=self.answer).start()

    def tick(self):
        ASK

    def answer(self):
        while rclpy.ok():
            version = self.fetch()
            ANSWER

    def fetch(self):
        time.sleep(0.2)
        return 3

rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Ship())
executor.spin()
"""
ASK = 'if self.busy or self.asked:\n            return\n        self.asked = True'
ANSWER = 'if self.asked and version > 1:\n                self.asked = False'


def races(ask: str = ASK, answer: str = ANSWER, group: str = 'None') -> list[str]:
    text = PROGRAM.replace('group=None', f'group={group}')
    units = scan_text(text.replace('ASK', ask).replace('ANSWER', answer)).units
    codes = (finding.code for finding in findings_of(units, [], [None]))
    return [code for code in codes if code.startswith('CC3')]


@pytest.mark.parametrize(
    'answer',
    [
        ANSWER,
        'if not self.asked:\n                continue\n            self.asked = False',
        'if self.asked:\n                self.asked = False',
        'if self.asked:\n                self.asked = version > 1',
    ],
)
def test_each_acts_in_its_own_state(answer: str) -> None:
    assert races(answer=answer) == []


@pytest.mark.parametrize(
    ('ask', 'answer', 'group'),
    [
        # It is put up, or may be put down, whatever was found; or by two at a time.
        ('self.asked = True', ANSWER, 'None'),
        (ASK, 'if self.asked or version > 1:\n                self.asked = False', 'None'),
        (ASK, ANSWER, 'ReentrantCallbackGroup()'),
    ],
)
def test_other_orders_are_told(ask: str, answer: str, group: str) -> None:
    assert races(ask, answer, group) != []


def test_two_threads_may_both_find_it_up() -> None:
    refuse = 'def refuse(self):\n        if self.asked:\n            self.asked = False'
    answer = f'{ANSWER}\n\n    {refuse}'
    start = 'threading.Thread(target=self.answer).start()'
    text = PROGRAM.replace(start, f'{start}\n        {start.replace("answer", "refuse")}')
    units = scan_text(text.replace('ASK', ASK).replace('ANSWER', answer)).units
    codes = [finding.code for finding in findings_of(units, [], [None])]
    assert [code for code in codes if code.startswith('CC3')] != []
