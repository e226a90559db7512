"""A method that is compared with ``None`` is there, also by ``==`` and ``!=``."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
from functools import partial

import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Unit(Node):
    def __init__(self, name, on_news=None):
        super().__init__(name)
        chosen = {chosen}
        self.create_subscription(Empty, 'news', chosen, 10)

    def default(self, msg):
        raise NotImplementedError

class Arm(Unit):
    def __init__(self):
        super().__init__('arm', {given})

    def on_news(self, msg):
        pass

rclpy.init()
rclpy.spin(Arm())
"""
WAYS = [
    'on_news if on_news != None else self.default',
    'self.default if on_news == None else on_news',
    'on_news if None != on_news else self.default',
]


@pytest.mark.parametrize('chosen', WAYS)
@pytest.mark.parametrize('given', ['self.on_news', 'partial(self.on_news)'])
def test_a_method_is_not_none(chosen: str, given: str) -> None:
    (unit,) = scan_text(PROGRAM.format(chosen=chosen, given=given)).units
    assert [(each.function_name, each.unresolved) for each in unit.callbacks] == [
        ('on_news', None)
    ]
