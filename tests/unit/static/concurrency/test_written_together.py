"""Attributes that are written one after the other, between which others may run."""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """
import time
import rclpy
from rclpy.node import Node
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.x, self.y, self.n = 0.0, 0.0, time.time()
        self.moved = False
        self.client = self.create_client(Trigger, 'permit')
        self.create_subscription(Odometry, 'odom', self.on_odom, 10)

    def scaled(self, value):
        return 2.0 * value

    KINDdef on_odom(self, msg):
        STORES

rclpy.init()
rclpy.spin(Follower())
"""
MESSAGE = 'self.x = msg.pose.x\nself.y = msg.pose.y'


def joins(stores: str, kind: str = '') -> list[tuple[str, str | None]]:
    """Each write of the callback, and with which earlier one it belongs."""
    text = PROGRAM.replace('STORES', textwrap.indent(stores, ' ' * 8).strip())
    (unit,) = scan_text(text.replace('KIND', kind)).units
    (callback,) = (each for each in unit.callbacks if each.function_name == 'on_odom')
    return [(write.name.partition('.')[2], write.joins) for write in callback.writes]


@pytest.mark.parametrize(
    ('stores', 'kind'),
    [
        (MESSAGE, ''),
        ('self.x = float(msg.pose.x)\nself.moved = True\nself.y = abs(msg.pose.y)', ''),
        ('self.x = self.n\ntime.sleep(0.1)\nself.y = self.n', ''),
        (
            'self.x = self.n\nawait self.client.call_async(Trigger.Request())\nself.y = self.n',
            'async ',
        ),
        ('if msg.header.stamp:\n    self.x = msg.pose.x\n    self.y = msg.pose.y', ''),
        ('self.x = self.n\nself.y = self.scaled(self.n)', ''),
        ('step = 1.0\nself.x = step\nself.y = self.scaled(step)', ''),
    ],
)
def test_others_may_run_between_values_of_a_message_and_over_a_wait(
    stores: str, kind: str
) -> None:
    found = dict(joins(stores, kind))
    assert {name: found[name] for name in ('x', 'y')} == {'x': None, 'y': 'Follower.x'}


@pytest.mark.parametrize(
    'stores',
    [
        'self.x, self.y = msg.pose.x, msg.pose.y',
        'self.x = msg.pose.x\nself.moved = True',
        'self.x = msg.pose.x\nself.y = time.time()',
        'x, y = self.scaled(1.0), self.scaled(2.0)\nself.x = x\nself.y = y',
        'self.x = self.scaled(self.n)\nself.y = 0.0',
        'if msg.header.stamp:\n    self.x = msg.pose.x\nelse:\n    self.y = msg.pose.y',
        'x, y = msg.pose.x, msg.pose.y\nself.x = x\nself.y = y',
    ],
)
def test_what_nobody_can_see_half_of_does_not(stores: str) -> None:
    assert {other for _, other in joins(stores)} == {None}


@pytest.mark.parametrize(
    ('stores', 'akin'),
    [
        (MESSAGE, True),
        ('self.x = self.n\ntime.sleep(0.1)\nself.y = self.n', True),
        ('self.x = time.time()\ntime.sleep(0.1)\nself.y = msg.pose.y', False),
    ],
)
def test_two_values_are_of_one_thing_where_both_name_it(stores: str, akin: bool) -> None:
    text = PROGRAM.replace('STORES', textwrap.indent(stores, ' ' * 8).strip())
    (unit,) = scan_text(text.replace('KIND', '')).units
    (callback,) = (each for each in unit.callbacks if each.function_name == 'on_odom')
    assert [write.akin for write in callback.writes] == [False, akin]
