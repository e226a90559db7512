"""A rate is given a frequency: its timer has the inverse as its period, also by assumption."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Unknown

PROGRAM = """
import rclpy
from rclpy.node import Node
from tools import load


class Gripper(Node):
    def __init__(self):
        super().__init__('gripper')
        self.declare_parameter('hz', 20.0)
        self.rate = self.create_rate({frequency})


rclpy.init()
rclpy.spin(Gripper())
"""


@pytest.mark.parametrize(
    ('frequency', 'period'),
    [
        ('4', 0.25),
        ("self.get_parameter('hz').value", 0.05),
        ("frequency=self.get_parameter('hz').value / 2", 0.1),
    ],
)
def test_the_period_of_a_rate_is_the_inverse(frequency: str, period: float) -> None:
    (unit,) = scan_text(PROGRAM.format(frequency=frequency)).units
    assert [each.period_s for each in unit.callbacks if each.library] == [period]


@pytest.mark.parametrize(
    'frequency',
    ['10**400', 'load()', "5 if self.count_publishers('x') else 10"],
)
def test_one_of_an_unknown_frequency_stays_open(frequency: str) -> None:
    (unit,) = scan_text(PROGRAM.format(frequency=frequency)).units
    (timer,) = [each for each in unit.callbacks if each.library]
    assert isinstance(timer.period_s, Unknown)


@pytest.mark.parametrize('frequency', ['0', '1e400', '1e-320'])
def test_no_period_comes_from_what_no_rate_has(frequency: str) -> None:
    (unit,) = scan_text(PROGRAM.format(frequency=frequency)).units
    assert [each.period_s for each in unit.callbacks if each.library] == [None]
