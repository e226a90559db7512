"""A rate that is destroyed while its node is spun: its timer ends no spin."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan

NODE = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger


class Sweeper(Node):
    def __init__(self):
        super().__init__('sweeper')
        group = MutuallyExclusiveCallbackGroup()
        self.create_service(Trigger, 'sweep', self.sweep, callback_group=group)

    def sweep(self, request, response):
        {make}
        {destroy}
        return response


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=3)
    executor.add_node(Sweeper())
    executor.spin()


main()
"""
RATE = 'made = self.create_rate(4)\n        made.sleep()'
TIMER = 'made = self.create_timer(0.2, print)'


@pytest.mark.parametrize(
    ('make', 'destroy', 'slugs'),
    [
        (RATE, 'self.destroy_rate(made)', []),
        (RATE, 'made.destroy()', []),
        (TIMER, 'self.destroy_timer(made)', ['destroyed-while-spun']),
    ],
)
def test_the_timer_of_a_rate_may_go(
    tmp_path: Path, make: str, destroy: str, slugs: list[str]
) -> None:
    path = tmp_path / 'sweeper.py'
    path.write_text(NODE.format(make=make, destroy=destroy))

    found = scan([path])

    assert [each.slug for each in found.diagnostics] == slugs
