"""CC303: a store that a run makes anyway, asked or not, does not rest on what it has read."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

KEPT = """
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Unit:
    def __init__(self, node):
        self.node = node
        {begin}

    def refresh(self):
        self.__scale = self.node.get_parameter('scale').value

    def scale(self):
        {get}
        return self.__scale

    def take(self):
        if {free}:
            self.__scale = self.node.get_name()


class Meter(Node):
    def __init__(self):
        super().__init__('meter')
        self.declare_parameter('scale', 1.0)
        self.unit = Unit(self)
        one, two = MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()
        self.create_timer(0.1, self.on_tick, callback_group=one)
        self.create_timer(0.2, self.on_tock, callback_group=two)

    def on_tick(self):
        {use}

    def on_tock(self):
        {use}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Meter())
executor.spin()
"""
TWICE = """if self.unit.scale() > 0:
            self.get_logger().info(str(self.unit.scale()))"""
BY_TEXT = 'if not {ask}:\n            self.refresh()'


def _acts(**parts: str) -> list[str]:
    text = KEPT.format(**{'begin': 'pass', 'get': 'pass', 'free': 'False', 'use': TWICE, **parts})
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return [f.message for f in found if 'reads Unit.__scale and then writes' in f.message]


@pytest.mark.parametrize(
    'get',
    [
        'self.refresh()',
        BY_TEXT.format(ask="hasattr(self, '__scale')"),
        BY_TEXT.format(ask="getattr(self, '__scale', None)"),
    ],
)
def test_what_is_stored_each_time_is_stored_for_no_reason(get: str) -> None:
    assert not _acts(get=get)


@pytest.mark.parametrize(
    'parts',
    [
        {
            'begin': 'self.__scale = 0.0',
            'get': 'if self.__scale == 0.0:\n            self.refresh()',
        },
        {'get': BY_TEXT.format(ask="getattr(self, '_Unit__scale', None)")},
        {
            'begin': 'self.__scale = None',
            'use': 'self.unit.take()',
            'free': 'self.__scale is None',
        },
        {
            'begin': 'self.__scale = None',
            'use': 'if self.unit.scale() is None:\n            self.unit.refresh()',
        },
    ],
)
def test_what_is_stored_because_of_a_read_rests_on_it(parts: dict[str, str]) -> None:
    assert _acts(**parts)


NAMED = """
import rclpy
from rclpy.node import Node


class Box:
    def fill(self):
        {store}

    def look(self):
        return hasattr(self, '__lid')


class Owner(Node):
    def __init__(self):
        super().__init__('owner')
        self.box = Box()
        self.create_timer(1.0, self.on_tick)
        {more}

    def on_tick(self):
        if self.box.look():
            self.create_timer(1.0, self.box.fill)


rclpy.init()
rclpy.spin(Owner())
"""


@pytest.mark.parametrize(
    ('store', 'more', 'timers'),
    [
        ('self.__lid = 1', 'pass', 1),
        ("setattr(self, '__lid', 1)", 'pass', 2),
        ('setattr(self, self.__name__, 1)', 'pass', 2),
        ("self.__dict__['__lid'] = 1", 'pass', 2),
        ('self.__lid = 1', "exec('self.box.__lid = 1')", 2),
    ],
)
def test_an_attribute_that_nothing_stores_is_not_there(store: str, more: str, timers: int) -> None:
    units = scan_text(NAMED.format(store=store, more=more)).units
    found = [each for unit in units for each in unit.callbacks if each.entity.value == 'timer']
    assert len(found) == timers
