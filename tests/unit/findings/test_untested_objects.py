"""CC305: an object that is used without any test while a callback sets it to ``None``."""

from __future__ import annotations

from textwrap import indent

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.collect import findings_of

PROGRAM = """\
import contextlib
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Source:
    def read(self):
        return 1

class Cam(Node):
    def __init__(self):
        super().__init__('cam')
        self.cap = Source()
        self.is_open = True
        self.stopped = threading.Event()
        self.lock = threading.Lock()
        self.create_service(Trigger, 'close', self.on_close)
        {start}

    def on_close(self, request, response):
{close}
        return response

    def loop(self):
{loop}

    def step(self):
{step}

rclpy.init()
node = Cam()
{spin}
"""
THREAD = """\
self.thread = threading.Thread(target=self.loop, daemon=True)
        self.thread.start()"""
TIMER = 'self.create_timer(0.1, self.step, callback_group=MutuallyExclusiveCallbackGroup())'
POOL = 'executor = MultiThreadedExecutor(2)\nexecutor.add_node(node)\nexecutor.spin()'
ONE = 'rclpy.spin(node)'
CLEAR, USE = 'self.cap = None', 'self.cap.read()\ntime.sleep(0.1)'
ENDLESS = 'while rclpy.ok():\n    self.step()'


def told(
    step: str,
    *,
    loop: str = ENDLESS,
    close: str = CLEAR,
    start: str = THREAD,
    spin: str = ONE,
) -> list[tuple[str, str]]:
    parts = {'close': close, 'loop': loop, 'step': step}
    inside = {name: indent(text, ' ' * 8) for name, text in parts.items()}
    units = scan_text(PROGRAM.format(start=start, spin=spin, **inside)).units
    found = findings_of(units, [], [None] * len(units))
    return [(each.code, each.severity.value) for each in found if each.code.startswith('CC3')]


def test_a_thread_and_a_callback_on_another_thread() -> None:
    assert told(USE) == [('CC305', 'warning')]
    assert told(USE, loop='while True:\n    self.step()') == [('CC305', 'warning')]
    assert told(USE, start=TIMER, spin=POOL) == [('CC305', 'warning')]


def test_one_thread_has_both() -> None:
    assert told(USE, start=TIMER) == []


JOIN = f'self.is_open = False\nself.thread.join()\n{CLEAR}'
EVENT = f'self.stopped.set()\nself.thread.join()\n{CLEAR}'


@pytest.mark.parametrize(
    'step',
    [
        'cap = self.cap\nif cap is not None:\n    cap.read()',
        'if self.is_open:\n    self.cap.read()',
        'if not self.is_open:\n    return\nself.cap.read()',
        'if self.stopped.is_set():\n    return\nself.cap.read()',
        'try:\n    self.cap.read()\nexcept AttributeError:\n    pass',
        'try:\n    self.cap.read()\nexcept (ValueError, Exception):\n    pass',
        'try:\n    self.cap.read()\nexcept:\n    pass',
        'with contextlib.suppress(AttributeError):\n    self.cap.read()',
        'print(self.cap)',
    ],
)
def test_it_is_guarded(step: str) -> None:
    close = f'self.is_open = False\nself.stopped.set()\n{CLEAR}'
    assert told(step, close=close) == []


@pytest.mark.parametrize(
    ('loop', 'close'),
    [
        ('while self.is_open:\n    self.step()', JOIN),
        ('while not self.stopped.is_set():\n    self.step()', EVENT),
        ('while not self.stopped.wait(0.1):\n    self.step()', EVENT),
        ('while True:\n    if self.stopped.is_set():\n        break\n    self.step()', EVENT),
        ('while True:\n    with self.lock:\n        self.step()', f'with self.lock:\n    {CLEAR}'),
        ('self.step()', CLEAR),
    ],
)
def test_the_thread_has_ended_or_waits(loop: str, close: str) -> None:
    assert told(USE, loop=loop, close=close) == []
