"""Nested spins of a node that nothing else serves end by what comes from outside, or by time."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Unknown

PROGRAM = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Helper(Node):
    def __init__(self):
        super().__init__('helper')
        self.client = self.create_client(Trigger, 'plan')
        self.create_subscription(String, 'text', self.on_text, 1)

    def on_text(self, msg):
        {helps}


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.helper = Helper()
        self.create_timer(1.0, self.drive, callback_group={group})
        self.create_timer(1.0, self.stop, callback_group=MutuallyExclusiveCallbackGroup())
        {more}

    def drive(self):
        future = self.helper.client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(self.helper, future{timeout})

    def stop(self):
        {stops}

    def answer(self, request, response):
        return response


rclpy.init()
executor = MultiThreadedExecutor(2)
executor.add_node(Arm())
{adds}
executor.spin()
"""
PLAIN = {'helps': 'pass', 'group': 'MutuallyExclusiveCallbackGroup()', 'more': '', 'adds': ''}
PLAIN |= {'timeout': '', 'stops': 'pass'}
SPINS = 'rclpy.spin_once(self.helper, timeout_sec=0.1)'
TAKEN = 'another spin of that executor may take the node away'
ELSEWHERE = 'an entity of another executor'


def ends(**parts: str) -> list[str]:
    """Who ends the spin of ``drive`` and its future; of what is open, the reason."""
    units = scan_text(PROGRAM.format(**PLAIN | parts)).units
    (drive,) = (c for unit in units for c in unit.callbacks if c.name == 'drive')
    return [
        ', '.join(waker.by for waker in block.wakers)
        or (block.on.reason if isinstance(block.on, Unknown) else str(block.on))
        for block in drive.blocking
    ]


def test_whoever_answers_outside_ends_it() -> None:
    assert ends() == ['time', 'outside']
    assert ends(timeout=', timeout_sec=1.0') == ['time', 'time']


@pytest.mark.parametrize('parts', [{'stops': SPINS}, {'group': 'ReentrantCallbackGroup()'}])
def test_a_spin_beside_it_may_take_the_node_away(parts: dict[str, str]) -> None:
    assert ends(**parts) == [TAKEN, TAKEN]
    assert ends(**parts, timeout=', timeout_sec=1.0') == ['time', 'time']


@pytest.mark.parametrize(
    'parts',
    [
        {'helps': 'self.client.call(Trigger.Request())'},
        {'more': "self.create_service(Trigger, 'plan', self.answer)"},
        {'adds': 'rclpy.spin(Helper())'},
    ],
    ids=['its callback waits', 'the program answers', 'the executor is spun'],
)
def test_what_else_may_matter_leaves_it_open(parts: dict[str, str]) -> None:
    assert ends(**parts) == [ELSEWHERE, ELSEWHERE]
