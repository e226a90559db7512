"""A comprehension sleeps once for each of its items, as a loop does."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.verify.results.rates import least_slept_s

PROGRAM = """
import time
import rclpy
from rclpy.node import Node

class Bus(Node):
    REGISTERS = range(0x6040, 0x604C)

    def __init__(self):
        super().__init__('bus')
        self.create_timer(2.0, self.diagnose)

    def read(self, index):
        time.sleep(0.5)
        return index

    def diagnose(self):
        {text}

rclpy.init()
rclpy.spin(Bus())
"""


@pytest.mark.parametrize(
    ('text', 'slept'),
    [
        ('[self.read(index) for index in (1, 2, 3)]', 1.5),
        ('[self.read(index) for index in self.REGISTERS]', 6.0),
        ('{self.read(index) for index in self.REGISTERS}', 6.0),
        ('{index: self.read(index) for index in self.REGISTERS}', 6.0),
        ('[self.read(i + k) for i in (1, 2) for k in range(20)]', 20.0),
        ('for index in self.REGISTERS: self.read(index)', 6.0),
        # It may end with the first one.
        ('any(self.read(index) for index in self.REGISTERS)', 0.5),
        ('[self.read(index) for index in self.REGISTERS if index > 5]', 0.5),
    ],
)
def test_what_a_comprehension_sleeps(text: str, slept: float) -> None:
    (unit,) = scan_text(PROGRAM.replace('{text}', text)).units
    (diagnose,) = [each for each in unit.callbacks if each.name == 'diagnose']
    assert least_slept_s(diagnose.blocking) == slept
