"""``__setattr__``, descriptors and ``__dict__``: attributes that the program handles itself."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

FLAG = """
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Bool, Empty

CLASSES

class Lamp(Node):
    BODY
    def __init__(self):
        super().__init__('lamp')
        SET_UP
        one = MutuallyExclusiveCallbackGroup()
        other = OTHER
        self.create_subscription(Bool, 'switch', self.on_switch, 10, callback_group=one)
        self.create_subscription(Empty, 'tick', self.on_tick, 10, callback_group=other)

    def on_switch(self, msg):
        SWITCH

    def on_tick(self, msg):
        TICK

rclpy.init()
executor = MultiThreadedExecutor(2)
executor.add_node(Lamp())
executor.spin()
"""

LATEST = """
class Latest:
    def __set_name__(self, owner, name):
        self._slot = '_latest_' + name
        self._changed = threading.Condition()

    def __get__(self, instance, owner=None):
        if instance is None:
            return self
        with self._changed:
            self._changed.wait_for(lambda: self._slot in instance.__dict__)
            return instance.__dict__[self._slot]

    def __set__(self, instance, value):
        with self._changed:
            instance.__dict__[self._slot] = value
            self._changed.notify_all()
"""

TOLD = """
class Told:
    def __init__(self):
        object.__setattr__(self, 'done', threading.Event())
        self.level = 0

    def __setattr__(self, name, value):
        SUPER.__setattr__(ARGUMENTS)
        self.done.wait()
"""

COUNTED = """
class Counted:
    def __init__(self):
        object.__setattr__(self, '_values', {})

    def __getattr__(self, name):
        return self._values.get(name, 0)

    def __setattr__(self, name, value):
        self._values[name] = value
"""

LEVEL = """
class Level:
    def __init__(self):
        self._level = 0

    @property
    def level(self):
        return self._level

    @level.setter
    def level(self, value):
        self._level = value
"""

APART = 'MutuallyExclusiveCallbackGroup()'


def program(
    switch: str,
    tick: str,
    *,
    classes: str = '',
    body: str = 'pass',
    set_up: str = 'pass',
    other: str = APART,
) -> str:
    text = FLAG.replace('CLASSES', classes).replace('BODY', body).replace('SET_UP', set_up)
    return text.replace('SWITCH', switch).replace('TICK', tick).replace('OTHER', other)


def found_in(text: str) -> dict[str, str]:
    found = findings_of(scan_text(text).units, [], [None])
    return {each.code: each.message for each in found if each.code[:3] in ('CC1', 'CC3')}


def of_descriptor(other: str) -> set[str]:
    assign, read = 'self.state = msg.data', 'print(self.state)'
    text = program(assign, read, classes=LATEST, body='state = Latest()', other=other)
    return set(found_in(text))


def test_a_descriptor_waits_where_its_attribute_is_read() -> None:
    assert of_descriptor('one') == {'CC101'}


def test_a_descriptor_is_told_where_its_attribute_is_assigned() -> None:
    assert of_descriptor(APART) == set()


@pytest.mark.parametrize(
    ('above', 'arguments'), [('super()', 'name, value'), ('object', 'self, name, value')]
)
@pytest.mark.parametrize(
    'switch', ['self.told.level = 1', "setattr(self.told, 'level', 1)", 'self.told.level += 1']
)
def test_a_wait_in_setattr_is_one_of_each_assignment(
    above: str, arguments: str, switch: str
) -> None:
    classes = TOLD.replace('SUPER', above).replace('ARGUMENTS', arguments)
    text = FLAG.replace('CLASSES', classes).replace('BODY', 'pass').replace('OTHER', 'one')
    text = text.replace('SET_UP', 'self.told = told').replace('SWITCH', switch)
    text = text.replace('TICK', 'self.told.done.set()').replace(
        'rclpy.init()', 'told = Told()\nrclpy.init()'
    )
    (unit,) = scan_text(text).units
    switch_on = next(each for each in unit.callbacks if each.function_name == 'on_switch')
    assert [block.call for block in switch_on.blocking] == ['Event.wait']
    assert 'Told.level' in [write.name for write in switch_on.writes]


@pytest.mark.parametrize(
    'statement',
    [
        'self.counted.ticks += 1',
        'self.counted.ticks = self.counted.ticks + 1',
        'n = self.counted.ticks; self.counted.ticks = n + 1',
    ],
)
@pytest.mark.parametrize('classes', [COUNTED, LEVEL.replace('Level', 'Counted')])
def test_an_update_by_way_of_code_may_be_lost(statement: str, classes: str) -> None:
    if classes != COUNTED:
        statement = statement.replace('ticks', 'level')
    text = program(statement, statement, classes=classes, set_up='self.counted = Counted()')
    assert 'what was read' in found_in(text)['CC301']


def test_an_attribute_that_nothing_has_set_yet_is_shared_data() -> None:
    classes = 'class Counted:\n    def __getattr__(self, name):\n        return 0'
    statement = 'self.counted.ticks += 1'
    text = program(statement, statement, classes=classes, set_up='self.counted = Counted()')
    assert 'one change can get lost' in found_in(text)['CC301']


@pytest.mark.parametrize(
    'switch',
    [
        "self.__dict__['on'] = True",
        'self.__dict__.update(on=True)',
        "vars(self).update({'on': True})",
        "setattr(self, 'on', True)",
    ],
)
def test_an_attribute_that_is_set_by_its_name_ends_a_wait(switch: str) -> None:
    tick = 'while not self.on:\n            pass'
    text = program(switch, tick, set_up='self.on = False')
    (unit,) = scan_text(text).units
    on_tick = next(each for each in unit.callbacks if each.function_name == 'on_tick')
    (wait,) = on_tick.blocking
    assert [waker.by for waker in wait.wakers] == ['on_switch']


def test_what_a_name_space_holds_is_data_of_its_holder() -> None:
    text = program(
        'self.space.on = True',
        'while not self.space.on:\n            pass',
        set_up='self.space = types.SimpleNamespace(on=False)',
        classes='import types',
    )
    (unit,) = scan_text(text).units
    on_tick = next(each for each in unit.callbacks if each.function_name == 'on_tick')
    (wait,) = on_tick.blocking
    assert [waker.by for waker in wait.wakers] == ['on_switch']
