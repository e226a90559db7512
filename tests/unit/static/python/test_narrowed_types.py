"""What ``isinstance`` has shown about an attribute or a name counts in the arms of the test."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger
from vendor import Gripper


class Dummy:
    def __init__(self):
        self.width = None

    def open(self):
        self.width = [1]


class Hand(Node):
    def __init__(self):
        super().__init__('hand')
        group = ReentrantCallbackGroup()
        self.declare_parameter('dummy', False)
        if self.get_parameter('dummy').value:
            self.tool = Dummy()
        else:
            self.tool = Gripper('10.0.0.1')
        self.create_service(Trigger, 'open', self.on_open, callback_group=group)
        self.create_timer(1.0, self.tick)

    def on_open(self, request, response):
        {}
        return response

    def tick(self):
        self.tool.open()

    {}


rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Hand())
executor.spin()
"""


def told(does: str, more: str = '') -> list[str]:
    text = PROGRAM.format(does.replace('\n', '\n        '), more.replace('\n', '\n    '))
    found = findings_of(scan_text(text).units, [], [None])
    return [finding.code for finding in found if finding.code.startswith('CC3')]


@pytest.mark.parametrize(
    'does',
    [
        'if isinstance(self.tool, Dummy):\n    return response\nself.tool.open()',
        'if isinstance(self.tool, Dummy):\n    pass\nelse:\n    self.tool.open()',
        'if not isinstance(self.tool, Dummy):\n    self.tool.open()',
        'tool = self.tool\nif request and not isinstance(tool, (Dummy, str)):\n    tool.open()',
        'is_dummy = isinstance(self.tool, Dummy)\nif not is_dummy:\n    self.tool.open()',
    ],
)
def test_what_it_is_not_is_not_followed(does: str) -> None:
    assert told(does) == []


@pytest.mark.parametrize(
    'does',
    [
        'self.tool.open()',
        'if isinstance(self.tool, Dummy):\n    self.tool.open()',
        'if not isinstance(self.tool, Dummy) or request:\n    self.tool.open()',
        'if isinstance(self.tool, Dummy):\n    pass\nself.tool.open()',
        'tool = self.tool\nif not isinstance(tool, Dummy):\n    tool = self.tool\n    tool.open()',
    ],
)
def test_what_it_may_be_is_followed(does: str) -> None:
    assert told(does) == ['CC302']


def test_an_attribute_that_others_assign_may_be_anything_behind_the_test() -> None:
    does = 'if not isinstance(self.tool, Dummy):\n    self.tool.open()'
    assert told(does, 'def swap(self):\n    self.tool = Dummy()') == ['CC302']
