"""A loop that may be left early sleeps at most in each of its rounds, and at least up to there."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.verify.results.rates import least_slept_s

PROGRAM = """
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32

class Prober(Node):
    def __init__(self):
        super().__init__('prober')
        self.orders = 0
        self.create_timer(1.0, self.probe)
        self.create_subscription(Int32, 'order', self.on_order, 1)

    def probe(self):
        for number in range(5):
            BODY

    def on_order(self, msg):
        self.orders = msg.data

rclpy.init()
rclpy.spin(Prober())
"""


@pytest.mark.parametrize(
    ('body', 'most', 'least'),
    [
        ('if self.orders:\n    return\ntime.sleep(0.3)', 1.5, 0.0),
        ('if self.orders:\n    break\ntime.sleep(0.3)', 1.5, 0.0),
        ('time.sleep(0.3)\nif self.orders:\n    return', 1.5, 0.3),
        ('if self.orders:\n    continue\ntime.sleep(0.3)', 1.5, 0.0),
        ('time.sleep(0.3)\nif number == 1:\n    break', 0.6, 0.6),
    ],
)
def test_such_a_loop(body: str, most: float, least: float) -> None:
    text = PROGRAM.replace('BODY', textwrap.indent(body, ' ' * 12).strip())
    (unit,) = scan_text(text).units
    (probe,) = (each for each in unit.callbacks if each.function_name == 'probe')
    slept = [b.seconds * b.times for b in probe.blocking if isinstance(b.seconds, float)]
    assert sum(slept) == pytest.approx(most)
    assert least_slept_s(probe.blocking) == pytest.approx(least)
