"""
What ends a loop that waits for plain data: every way to look at it is one wait.

Each test is asked of two programs: one thread, where the writer cannot run, and a pool with the
writer in a group of its own, where it can.
"""

from __future__ import annotations

import textwrap

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking

PROGRAM = """
import math
import queue
import threading
import time
from dataclasses import dataclass
from enum import Enum

import rclpy
from geometry_msgs.msg import Point, Twist
from rclpy.node import Node
from std_msgs.msg import String
from armlib import Arm


class Phase(Enum):
    IDLE = 0
    DONE = 1


@dataclass
class Status:
    phase: Phase = Phase.IDLE


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        {made}
        self.create_subscription(String, 'news', self.on_news, 10)
        self.create_timer(1.0, self.tick)

    def on_news(self, msg):
        {written}

    def peek(self):
        return self.pose

    def tick(self):
{loop}


def main():
    rclpy.init()
    rclpy.spin(Waiter())
"""


def _waits(made: str, written: str, loop: str) -> list[Blocking]:
    text = PROGRAM.format(
        made=made, written=written, loop=textwrap.indent(textwrap.dedent(loop).strip(), ' ' * 8)
    )
    (unit,) = scan_text(text).units
    tick = next(each for each in unit.callbacks if each.name == 'tick')
    return [block for block in tick.blocking if block.call != 'time.sleep']


def _while(test: str) -> str:
    return f'while {test}:\n    time.sleep(0.1)'


POSE = ('self.pose = None', 'self.pose = msg')
COPIES = [
    _while('(pose := self.pose) is None'),
    _while('not (pose := self.peek())'),
    """
    pose = self.pose
    while pose is None:
        time.sleep(0.1)
        pose = self.pose
    """,
    """
    while True:
        pose = self.pose
        if pose is not None:
            break
        time.sleep(0.1)
    """,
    """
    while True:
        first = self.pose
        second = first
        if second is not None:
            break
        time.sleep(0.1)
    """,
]


@pytest.mark.parametrize('loop', COPIES)
def test_a_local_copy_is_what_it_was_taken_of(loop: str) -> None:
    (wait,) = _waits(*POSE, loop)
    assert (wait.call, [waker.by for waker in wait.wakers]) == ('polling loop', ['on_news'])
    assert (wait.seconds, wait.escapes) == (None, None)


@pytest.mark.parametrize(
    ('made', 'written', 'test'),
    [
        ('self.data = {}', "self.data['a'] = msg", "self.data.get('a') is None"),
        ('self.data = []', 'self.data.append(msg)', 'self.data.count(1) == 0'),
        ('self.far = 10.0', 'self.far = float(msg.data)', 'abs(self.far) > 0.5'),
        ('self.x = 1.0; self.y = 1.0', 'self.x = 0.0', 'math.hypot(self.x, self.y) > 0.5'),
        ("self.word = ''", 'self.word = msg.data', "self.word.strip() != 'ok'"),
        ("self.word = ''", 'self.word = msg.data', "not self.word.startswith('ok')"),
        ("self.seen = {'a': False}", 'self.seen[msg.data] = True', 'not all(self.seen.values())'),
        ('self.at = Point()', 'self.at.x = 1.0', 'self.at.x < 0.5'),
        ('self.at = Point()', 'self.at = Point(x=1.0)', 'math.sqrt(self.at.x ** 2) < 0.5'),
        ('self.last = Twist()', 'self.last.linear.x = 1.0', 'self.last.linear.x < 0.5'),
    ],
)
def test_whatever_only_looks_at_data_waits_for_its_writer(
    made: str, written: str, test: str
) -> None:
    (wait,) = _waits(made, written, _while(test))
    assert (wait.call, [waker.by for waker in wait.wakers]) == ('polling loop', ['on_news'])
    assert (wait.seconds, wait.escapes) == (None, None)


def test_an_enumeration_is_a_member_of_the_class_that_has_it_as_an_attribute() -> None:
    (wait,) = _waits(
        'self.status = Status()',
        'self.status.phase = Phase.DONE',
        _while('self.status.phase != Phase.DONE'),
    )
    assert [waker.by for waker in wait.wakers] == ['on_news']


@pytest.mark.parametrize(
    ('made', 'loop'),
    [
        ('self.arm = Arm()', _while('not self.arm.connected')),
        ('self.arm = Arm()', _while('not self.arm.is_there()')),
        ('self.arm = Arm()', _while('self.arm.plan().state != 3')),
        ('self.arm = Arm(); self.active = True', _while('self.active and not self.arm.done')),
        ('self.arm = Arm(); self.arm.ok = False', _while('not self.arm.ok')),
        (
            'self.arm = Arm()',
            """
            while True:
                state = self.arm.state()
                if state == 'idle':
                    break
                time.sleep(0.1)
            """,
        ),
        ('self.got = []; Arm().stream(self.got)', _while('not self.got')),
    ],
)
def test_what_code_that_is_not_followed_may_end_is_open(made: str, loop: str) -> None:
    (wait,) = (each for each in _waits(made, 'pass', loop) if each.call == 'polling loop')
    assert wait.escapes is not None
    assert wait.seconds is None


@pytest.mark.parametrize(
    'loop',
    [
        """
        left = 5
        while self.pose is None and left > 0:
            left -= 1
            time.sleep(0.1)
        """,
        """
        end = time.time() + 5
        while self.pose is None:
            left = end - time.time()
            if left < 0:
                return
            time.sleep(0.1)
        """,
    ],
)
def test_what_time_or_a_count_ends_ends_by_itself(loop: str) -> None:
    (wait,) = _waits(*POSE, loop)
    assert wait.seconds is not None


WAIT_FOR_POSE = """
    def wait_for_pose(self, timeout=None):
        start = time.time()
        while self.pose is None:
            if timeout is not None and time.time() - start > timeout:
                return False
            time.sleep(0.1)
        return True
"""


@pytest.mark.parametrize(('timeout', 'is_timed'), [('', False), ('5.0', True)])
def test_a_way_out_that_is_never_taken_is_none(timeout: str, is_timed: bool) -> None:
    text = PROGRAM.replace('    def peek(self)', f'{WAIT_FOR_POSE}\n    def peek(self)')
    text = text.format(
        made=POSE[0], written=POSE[1], loop=f'        self.wait_for_pose({timeout})'
    )
    (unit,) = scan_text(text).units
    tick = next(each for each in unit.callbacks if each.name == 'tick')
    (wait,) = (block for block in tick.blocking if block.call == 'polling loop')
    assert (wait.seconds is not None) is is_timed


def test_what_a_round_makes_shorter_is_no_wait() -> None:
    loop = """
    value = self.pose
    while len(value) > 1 and value.endswith('/'):
        value = value[:-1]
    """
    assert all(wait.escapes is None for wait in _waits("self.pose = 'a/'", 'pass', loop))


def test_a_queue_that_is_asked_whether_it_is_empty_is_waited_for_as_by_get() -> None:
    (wait,) = _waits(
        'self.news = queue.Queue()', 'self.news.put(msg)', _while('self.news.empty()')
    )
    assert (wait.call, [waker.by for waker in wait.wakers]) == ('Queue.get', ['on_news'])


def test_an_event_or_data_is_the_first_of_several() -> None:
    (wait,) = _waits(
        'self.event = threading.Event(); self.ready = False',
        'self.ready = True',
        _while('not (self.ready or self.event.is_set())'),
    )
    assert wait.escapes is not None
    assert wait.escapes.reason == 'it waits for the first of several'


SET_UP = """
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.pose = None
        self.lock = threading.Lock()
        self.create_subscription(String, 'pose', self.on_pose, 10)
{loop}

    def on_pose(self, msg):
        self.pose = msg

def main():
    rclpy.init()
    rclpy.spin(Waiter())
"""


@pytest.mark.parametrize(
    ('loop', 'line'),
    [
        (COPIES[0], 14),
        (COPIES[3], 16),
        (
            """
            while True:
                with self.lock:
                    if self.pose is not None:
                        break
                time.sleep(0.1)
            """,
            16,
        ),
    ],
)
def test_a_constructor_that_waits_for_data_before_the_spin_waits_forever(
    loop: str, line: int
) -> None:
    text = SET_UP.format(loop=textwrap.indent(textwrap.dedent(loop).strip(), ' ' * 8))
    (found,) = scan_text(text).diagnostics
    assert (found.slug, found.severity.value, found.place.line) == ('nobody-spins', 'error', line)


@pytest.mark.parametrize('test', ['not self.pilot.reached', "self.pilot['reached'] is None"])
def test_what_is_none_for_all_that_is_known_raises_and_is_left_open(test: str) -> None:
    (wait,) = _waits('self.pilot = None', 'self.pose = msg', _while(test))
    assert wait.call == 'polling loop'
    assert wait.escapes is not None
    assert wait.escapes.reason == 'self.pilot is None, so that the test raises an exception'


def test_what_another_callback_makes_is_not_only_none() -> None:
    (wait,) = _waits('self.pilot = None', 'self.pilot = Status()', _while('not self.pilot.phase'))
    assert wait.escapes is None or 'is None' not in wait.escapes.reason
