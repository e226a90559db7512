"""A key that is a constant of its module means one item; a name that is bound twice does not."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import rclpy
from rclpy.node import Node
{bound}


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.speeds = {{64: 0, 65: 0}}
        self.create_timer(1.0, self.tick)

    def tick(self):
        {before}
        self.speeds[LEFT] += 1


{after}
rclpy.init()
rclpy.spin(Arm())
"""
SET = """\
def left():
    global LEFT
    LEFT = 65"""


def item(bound: str, before: str = 'pass', after: str = '') -> str | None:
    text = PROGRAM.format(bound=bound, before=before, after=after)
    (unit,) = scan_text(text).units
    (tick,) = unit.callbacks
    (write,) = tick.writes
    return write.item


@pytest.mark.parametrize('bound', ['LEFT = 0x40', 'LEFT: int = 64', 'LEFT = RIGHT = 64'])
def test_a_constant_of_the_module_is_one_key(bound: str) -> None:
    assert item(bound) == '64'


@pytest.mark.parametrize(
    ('bound', 'before', 'after'),
    [
        ('LEFT = 64\nLEFT = 65', 'pass', ''),
        ('LEFT = 64', 'pass', SET),
        ('LEFT = 64', 'pass', 'for LEFT in (64, 65):\n    pass'),
        ('LEFT = 64', 'pass', 'def left(LEFT):\n    pass'),  # some other one
        ('LEFT = input()', 'pass', ''),
        ('import arm as LEFT', 'pass', ''),
    ],
)
def test_another_name_may_mean_any(bound: str, before: str, after: str) -> None:
    assert item(bound, before, after) is None
