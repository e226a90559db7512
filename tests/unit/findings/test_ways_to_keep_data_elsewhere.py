"""
CC301: two callbacks change what is in a queue, or data that is no attribute of a scanned object.

Each way is bad without a lock, and right under one lock and in one group.
"""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

NODE = """\
import collections, functools, itertools, queue, threading, time, types
import rclpy
from nav_msgs.msg import Odometry
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

total = 0
STATE = types.SimpleNamespace(n=0)

{before}

class Counter(Node):
    def __init__(self):
        super().__init__('counter')
        self.n = 0
        self.guard = threading.Lock()
        {made}
        one = MutuallyExclusiveCallbackGroup()
        two = MutuallyExclusiveCallbackGroup() if {apart} else one
        self.create_subscription(String, 'a', self.on_a, 10, callback_group=one)
        self.create_subscription(String, 'b', self.on_b, 10, callback_group=two)

    def cost(self, msg):
        time.sleep(0.01)
        return len(msg.data)

    def on_a(self, msg):
{on_a}

    def on_b(self, msg):
{on_b}


rclpy.init()
executor = MultiThreadedExecutor(num_threads=4)
executor.add_node(Counter())
executor.spin()
"""
QUEUE = 'self.q = queue.Queue()'
SMALL = 'self.q = queue.Queue(maxsize=1)'
WAYS = {
    'empty_get_nowait': (QUEUE, 'if not self.q.empty():\n    print(self.q.get_nowait())'),
    'empty_get': (QUEUE, 'if not self.q.empty():\n    print(self.q.get())'),
    'empty_return': (QUEUE, 'if self.q.empty():\n    return\nprint(self.q.get_nowait())'),
    'size_get': (QUEUE, 'if self.q.qsize() > 0:\n    print(self.q.get(block=False))'),
    'size_local': (QUEUE, 'n = self.q.qsize()\nif n:\n    print(self.q.get_nowait())'),
    'as_many': (QUEUE, 'for _ in range(self.q.qsize()):\n    print(self.q.get_nowait())'),
    'drain': (QUEUE, 'while not self.q.empty():\n    print(self.q.get_nowait())'),
    'full_put': (SMALL, 'if not self.q.full():\n    self.q.put_nowait(msg)'),
    'full_drop': (SMALL, 'if self.q.full():\n    self.q.get_nowait()'),
    'drain_list': ('self.l = [1]', 'while self.l:\n    time.sleep(0.01)\n    self.l.pop()'),
    'namespace': ('self.s = types.SimpleNamespace(n=0)', 'self.s.n += self.cost(msg)'),
    'namespace_global': ('pass', 'STATE.n += self.cost(msg)'),
    'namespace_test': (
        'self.s = types.SimpleNamespace(arm=None)',
        'if self.s.arm is None:\n    time.sleep(0.01)\n    self.s.arm = object()',
    ),
    'message': ('self.m = String()', 'self.m.data += str(self.cost(msg))'),
    'message_field': ('self.m = Odometry()', 'self.m.pose.x += self.cost(msg)'),
    'message_split': ('self.m = Odometry()', 'self.m.pose.x = self.m.pose.x + self.cost(msg)'),
    'globals': ('pass', 'globals()["total"] += self.cost(msg)'),
    'vars': ('pass', 'vars(self)["n"] += self.cost(msg)'),
    'dict_update': ('self.t = {"n": 0}', 'self.t.update(n=self.t["n"] + self.cost(msg))'),
    'dict_setitem': (
        'self.t = {"n": 0}',
        'self.t.__setitem__("n", self.t["n"] + self.cost(msg))',
    ),
    'generator': ('self.g = count_up()\nnext(self.g)', 'self.g.send(self.cost(msg))'),
    'generator_next': ('self.g = count_up()', 'print(next(self.g))'),
    'default_list': ('pass', 'seen(msg)'),
    'default_dict': ('pass', 'counted(msg)'),
    'default_of_lambda': (
        'self.f = lambda k, t={"n": 0}: t.update(n=t["n"] + k)',
        'self.f(self.cost(msg))',
    ),
    'of_function': ('pass', 'bump(msg)'),
    'of_function_outside': ('bump.n = 0', 'bump.n += self.cost(msg)'),
    'of_wrapper': ('pass', 'work(msg)'),
    'kept_dict': ('pass', 't = table("x")\nt["n"] = t["n"] + self.cost(msg)'),
    'kept_object': ('pass', 'thing().n += self.cost(msg)'),
    'partial': ('self.f = functools.partial(counted_in, {"n": 0})', 'self.f(msg)'),
    'deleted': (
        'self.arm = 1',
        'if hasattr(self, "arm"):\n    time.sleep(0.01)\n    del self.arm',
    ),
    'asserted': ('self.free = True', 'assert self.free\ntime.sleep(0.01)\nself.free = False'),
}
"""What is made, and what both callbacks do."""
NOTES = frozenset({'deleted'})
"""Neither reads it again, so that only the order is open."""
BEFORE = """\
def count_up():
    n = 0
    while True:
        time.sleep(0.01)
        n += (yield n) or 1

def seen(msg, known=[]):
    if known:
        time.sleep(0.01)
        known.pop()
    known.append(msg)

def counted(msg, known={'n': 0}):
    counted_in(known, msg)

def counted_in(known, msg):
    x = known['n']
    time.sleep(0.01)
    known['n'] = x + 1

def bump(msg):
    x = bump.n
    time.sleep(0.01)
    bump.n = x + 1
bump.n = 0

def calls_counted(function):
    @functools.wraps(function)
    def wrapper(*args):
        x = wrapper.calls
        time.sleep(0.01)
        wrapper.calls = x + 1
        return function(*args)
    wrapper.calls = 0
    return wrapper

@calls_counted
def work(msg):
    pass

@functools.lru_cache
def table(key):
    return {'n': 0}

class Thing:
    def __init__(self):
        self.n = 0

@functools.cache
def thing():
    return Thing()
"""
RIGHT = {
    'caught': (QUEUE, 'try:\n    print(self.q.get_nowait())\nexcept queue.Empty:\n    pass'),
    'asked_and_caught': (
        QUEUE,
        'if not self.q.empty():\n    try:\n        print(self.q.get_nowait())\n'
        '    except queue.Empty:\n        pass',
    ),
    'put': (QUEUE, 'self.q.put(msg)'),
    'setdefault': ('self.t = {}', 'self.t.setdefault(msg.data, []).append(1)'),
    'update': ('self.t = {}', 'self.t.update(n=1)'),
    'default_read': ('pass', 'print(allowed(msg))'),
    'of_each_thread': (
        'self.s = threading.local()',
        'self.s.n = self.cost(msg)\nprint(self.s.n)',
    ),
    'next_of_count': ('self.c = itertools.count()', 'print(next(self.c))'),
    'of_its_own': ('pass', 'm = String()\nm.data = "a"\nm.data += str(self.cost(msg))'),
    'of_the_message': ('pass', 'msg.data += str(self.cost(msg))'),
    'read': ('self.m = Odometry()', 'print(self.m.pose.x, STATE.n, total)'),
}
ONE_TAKER = {
    'queue': (
        QUEUE,
        'if not self.q.empty():\n    print(self.q.get_nowait())',
        'self.q.put(msg)',
    ),
    'room': (
        SMALL,
        'if not self.q.full():\n    self.q.put_nowait(msg)',
        'print(self.q.get(timeout=1.0))',
    ),
    'list': ('self.l = []', 'while self.l:\n    self.l.pop(0)', 'self.l.append(msg)'),
}


def told(made: str, on_a: str, on_b: str, *, apart: bool = True) -> set[Severity | None]:
    text = NODE.format(
        before=f'{BEFORE}\ndef allowed(msg, known=[1, 2]):\n    return msg.data in known\n',
        made=indent(made, ' ' * 8).strip(),
        apart=apart,
        on_a=indent(on_a, ' ' * 8),
        on_b=indent(on_b, ' ' * 8),
    )
    units = scan_text(text).units
    found = findings_of(units, [], [None] * len(units))
    return {each.severity for each in found if each.code.startswith('CC3')}


@pytest.mark.parametrize('way', WAYS)
def test_what_two_callbacks_change_together_is_told(way: str) -> None:
    made, both = WAYS[way]
    weight = told(made, both, both)
    assert weight == {Severity.NOTE} if way in NOTES else Severity.WARNING in weight


@pytest.mark.parametrize('way', WAYS)
def test_the_same_under_one_lock_or_in_one_group_is_not(way: str) -> None:
    made, both = WAYS[way]
    locked = f'with self.guard:\n{indent(both, " " * 4)}'
    assert told(made, locked, locked) == set()
    assert told(made, both, both, apart=False) == set()


@pytest.mark.parametrize('way', RIGHT)
def test_what_is_in_one_piece_or_ones_own_is_not(way: str) -> None:
    made, both = RIGHT[way]
    assert told(made, both, both) == set()


@pytest.mark.parametrize('way', ONE_TAKER)
def test_one_that_takes_or_fills_alone_finds_what_it_has_found(way: str) -> None:
    assert told(*ONE_TAKER[way]) == set()
