"""A synchronizer of message_filters holds its lock while it calls what waits for all inputs."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import rclpy
from message_filters import ApproximateTimeSynchronizer, Cache, Subscriber, TimeSynchronizer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from sensor_msgs.msg import Image


class Pair(Node):
    def __init__(self):
        super().__init__('pair')
        group = ReentrantCallbackGroup()
        left = Subscriber(self, Image, 'left', callback_group=group)
        right = Subscriber(self, Image, 'right', callback_group=group)
        self.weight = 0
        {}

    def on_both(self, *messages):
        self.weight += self.weigh(messages)

    def weigh(self, messages):
        return len(messages)


rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Pair())
executor.spin()
"""
ONE = 'self.both = {}\n        self.both.registerCallback(self.on_both)'
ANOTHER = '\n        self.more = {}\n        self.more.registerCallback(self.on_both)'
EXACT, ABOUT = 'TimeSynchronizer([left, right], 5)', 'ApproximateTimeSynchronizer({}, 5, 0.1)'


def told(makes: str) -> list[str]:
    found = findings_of(scan_text(PROGRAM.format(makes)).units, [], [None])
    return [finding.code for finding in found if finding.code.startswith('CC3')]


@pytest.mark.parametrize('made', [EXACT, ABOUT.format('[left, right]')])
def test_calls_of_one_synchronizer_do_not_overlap(made: str) -> None:
    assert told(ONE.format(made)) == []


@pytest.mark.parametrize(
    'makes',
    [
        ONE.format('Cache(left, 5)'),
        'left.registerCallback(self.on_both)',
        ONE.format(EXACT) + ANOTHER.format(EXACT),
        ONE.format(EXACT) + '\n        left.registerCallback(self.on_both)',
        ONE.format(EXACT) + '\n        self.create_timer(0.1, self.on_both, callback_group=group)',
    ],
)
def test_calls_of_others_may_overlap(makes: str) -> None:
    assert told(makes) != []
