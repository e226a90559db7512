"""What is stored under a key that a dictionary has already changes no size under a loop."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Int32


class Panel(Node):
    def __init__(self):
        super().__init__('panel')
        self.state = {{'speed': 0, 'mode': 'idle'}}
        self.joints = {{'left': {{'speed': 0}}, 'right': {{'speed': 0}}}}
        group = MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.show)
        self.create_subscription(Int32, 'speed', self.on_speed, 10, callback_group=group)

    def show(self):
        for name, value in self.state.items():
            print(name, value)
        for name, joint in self.joints.items():
            print(name, joint)

    def on_speed(self, msg):
        {}


rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Panel())
executor.spin()
"""


def told(does: str) -> list[str]:
    found = findings_of(scan_text(PROGRAM.format(does)).units, [], [None])
    return [finding.code for finding in found if finding.code.startswith('CC3')]


@pytest.mark.parametrize(
    'does',
    [
        "self.state['speed'] = msg.data",
        'self.state.update(speed=msg.data)',
        "self.state.update({'speed': msg.data, 'mode': 'on'})",
        "self.joints['left']['speed'] = msg.data",
    ],
)
def test_a_key_that_is_there(does: str) -> None:
    assert told(does) == []


@pytest.mark.parametrize(
    'does',
    [
        "self.state['time'] = msg.data",
        'self.state[msg.data] = 1',
        'self.state.update(time=msg.data)',
        "self.state.update({'speed': 1, 'time': 2})",
        'self.state.update({**msg.data})',
        'self.state.update(msg.data)',
        'self.state.pop("speed")',
        "self.joints['third'] = {}",
    ],
)
def test_a_key_that_may_be_new(does: str) -> None:
    assert told(does) == ['CC301']
