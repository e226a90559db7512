"""Who destroys its node and then ends the program leaves no spin with nothing to serve."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import sys

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty


class Job(Node):
    def __init__(self):
        super().__init__('job')
        self.create_subscription(Empty, 'go', self.on_go, 10)

    def on_go(self, msg):
        self.finish()

    def finish(self):
        self.destroy_node()
        {then}


rclpy.init()
rclpy.spin(Job())
"""


@pytest.mark.parametrize(
    ('then', 'slugs'),
    [
        ('pass', ['served-no-more']),
        ('sys.exit(0)', []),
        ('raise SystemExit', []),
    ],
)
def test_a_method_that_the_callback_calls_may_end_it(then: str, slugs: list[str]) -> None:
    found = scan_text(PROGRAM.format(then=then)).diagnostics
    assert [each.slug for each in found] == slugs
