"""Functions that the standard library calls, and methods behind its questions, wait as others."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

NODE = """
import collections
import contextlib
import functools
import itertools
import operator
import threading
import types
import weakref
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Part:
    def __init__(self, node):
        self.node = node

    def METHOD(self, *args):
        self.node.wait()
        return RESULT

class Mill(Node):
    def __init__(self):
        super().__init__('mill')
        self.done = threading.Event()
        self.part = Part(self)
        self.stack = contextlib.ExitStack()
        threading.Thread(target=self.beside, daemon=True).start()
        self.create_subscription(Empty, 'tick', self.on_tick, 10)

    def wait(self, *args):
        self.done.wait()
        return 1

    def look(self):
        return self.wait()

    now = property(look)
    level = property(None, wait)

    def beside(self):
        self.wait()

    def on_tick(self, msg):
        STATEMENT

rclpy.init()
rclpy.spin(Mill())
"""


def waits_of(statement: str, method: str = 'go', result: str = '1') -> list[str]:
    text = NODE.replace('STATEMENT', statement).replace('METHOD', method)
    (unit,) = scan_text(text.replace('RESULT', result)).units
    (on_tick,) = unit.callbacks
    return [block.call for block in on_tick.blocking]


@pytest.mark.parametrize(
    'statement',
    [
        'max([1, 2], key=self.wait)',
        'min(msg.data, key=lambda each: self.wait(each))',
        'sorted(msg.data, key=self.wait)',
        'functools.reduce(self.wait, msg.data)',
        'list(itertools.takewhile(self.wait, msg.data))',
        "operator.methodcaller('wait')(self)",
        "operator.attrgetter('now')(self)",
        'types.MethodType(Mill.wait, self)()',
        'weakref.WeakMethod(self.wait)()()',
        'weakref.ref(self.done)().wait()',
        'self.now',
        'self.level = 2',
        'collections.defaultdict(self.wait)[msg]',
        'with contextlib.ExitStack() as stack:\n            stack.callback(self.wait, 1)',
        'with contextlib.ExitStack() as stack:\n            stack.push(lambda *why: self.wait())',
        'self.stack.callback(self.wait)\n        self.stack.close()',
    ],
)
def test_a_function_that_is_given_away_waits_where_it_is_called(statement: str) -> None:
    assert waits_of(statement) == ['Event.wait']


@pytest.mark.parametrize(
    'statement', ['contextlib.ExitStack().callback(self.wait)', 'weakref.WeakMethod(self.wait)']
)
def test_what_is_only_kept_does_not_wait_yet(statement: str) -> None:
    assert waits_of(statement) == []


@pytest.mark.parametrize(
    ('method', 'statement'),
    [
        ('__bool__', 'if self.part:\n            pass'),
        ('__bool__', 'print(not self.part)'),
        ('__len__', 'print(self.part and 1)'),
        ('__str__', "print(f'{self.part}')"),
        ('__repr__', "print(f'{self.part!r}')"),
        ('__str__', 'str(self.part)'),
        ('__repr__', 'repr(self.part)'),
        ('__float__', 'float(self.part)'),
        ('__abs__', 'abs(self.part)'),
        ('__neg__', 'print(-self.part)'),
        ('__next__', 'next(self.part)'),
        ('__iter__', 'first, second = self.part'),
        ('__iter__', 'print(list(self.part))'),
        ('__exit__', 'self.stack.push(self.part)\n        self.stack.close()'),
        (
            'close',
            'with contextlib.closing(self.part):\n            pass',
        ),
    ],
)
def test_the_method_behind_a_question_waits(method: str, statement: str) -> None:
    result = '[1, 2]' if method == '__iter__' else '1'
    assert waits_of(statement, method, result) == ['Event.wait']
