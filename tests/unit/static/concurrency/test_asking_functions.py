"""Loops on plain data that ask by functions of the program: these only look, or do more."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking

PROGRAM = """
import time
import rclpy
import rules
from rclpy.node import Node
from std_msgs.msg import Empty

class Lift(Node):
    def __init__(self):
        super().__init__('lift')
        self.level = 0
        self.asked = lambda level: self.level == level
        self.create_subscription(Empty, 'level', self.on_level, 10)
        self.create_timer(1.0, self.tick)

    def on_level(self, msg):
        self.level = 3

    def is_there(self, level):
        return {answer}

    def tick(self):
        level = 3
        while not {test}:
            time.sleep(0.02)

rclpy.init()
rclpy.spin(Lift())
"""
LOOKS = 'bool(self.level) and self.level == level'


def _loop(test: str, answer: str) -> Blocking:
    (unit,) = scan_text(PROGRAM.format(test=test, answer=answer)).units
    tick = next(each for each in unit.callbacks if each.name == 'tick')
    (loop,) = (block for block in tick.blocking if block.call == 'polling loop')
    return loop


@pytest.mark.parametrize(
    ('test', 'answer', 'is_timed'),
    [
        ('self.is_there(level)', LOOKS, False),
        ('self.asked(level)', LOOKS, False),
        ('self.is_there(level)', f'time.time() > 5 or {LOOKS}', True),
    ],
)
def test_a_function_that_only_looks_ends_no_loop_by_itself(
    test: str, answer: str, is_timed: bool
) -> None:
    loop = _loop(test, answer)
    assert (loop.seconds is not None) == is_timed
    assert [waker.by for waker in loop.wakers] == ['on_level']


def test_a_function_that_asks_what_is_not_followed_leaves_the_end_open() -> None:
    loop = _loop('self.is_there(level)', f'rules.given_up() or {LOOKS}')
    assert loop.seconds is None
    assert loop.escapes is not None
    assert loop.escapes.reason == 'what ends the loop: not self.is_there(level)'
