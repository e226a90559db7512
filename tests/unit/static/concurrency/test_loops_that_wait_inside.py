"""Loops of callbacks that wait for something in their rounds, and for the end of the loop too."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import ENDLESS_LOOP, POLLING_LOOP, Blocking

PROGRAM = """
import queue
import sys
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Gauge(Node):
    def __init__(self):
        super().__init__('gauge')
        self.lines = queue.Queue()
        self.tick = threading.Event()
        self.running = True
        self.create_subscription(String, 'stop', self.on_stop, 10)
        self.create_timer(1.0, self.work)

    def on_stop(self, msg):
        self.running = False
        self.tick.set()
        self.lines.put(msg)

    def show(self, line):
        {show}

    def work(self):
        {work}

rclpy.init()
try:
    rclpy.spin(Gauge())
except KeyboardInterrupt:
    pass
"""
ROUND = 'self.show(self.lines.get())'


def last_wait(work: str, show: str = 'pass') -> Blocking:
    text = PROGRAM.format(work=work.replace('\n', '\n        '), show=show)
    (unit,) = scan_text(text).units
    return next(each for each in unit.callbacks if each.name == 'work').blocking[-1]


def loop(test: str, *statements: str) -> str:
    return '\n    '.join([f'while {test}:', *statements])


@pytest.mark.parametrize('test', ['True', 'rclpy.ok()'])
@pytest.mark.parametrize('inside', [ROUND, 'time.sleep(0.1)', 'self.tick.wait(0.1)', 'pass'])
def test_nothing_ends_a_loop_without_a_way_out(test: str, inside: str) -> None:
    wait = last_wait(loop(test, inside))
    assert (wait.call, wait.wakers, wait.escapes) == (ENDLESS_LOOP, (), None)


def test_an_exception_that_is_caught_around_it_may_end_it() -> None:
    wait = last_wait(f'try:\n    {loop("True", f"    {ROUND}")}\nexcept ValueError:\n    pass')
    assert wait.escapes is not None
    assert wait.escapes.reason == 'only an exception or the end of the program ends it'


@pytest.mark.parametrize('end', ['sys.exit(1)', 'rclpy.shutdown()'])
def test_code_of_its_rounds_may_end_the_program(end: str) -> None:
    wait = last_wait(loop('rclpy.ok()', ROUND), show=f'if line: {end}')
    assert wait.escapes is not None
    assert wait.escapes.reason == 'code that its rounds may call ends the program'


@pytest.mark.parametrize('inside', [ROUND, 'self.tick.wait(0.1)', 'time.sleep(0.1)'])
def test_a_loop_that_works_waits_for_its_flag_too(inside: str) -> None:
    wait = last_wait(loop('self.running', inside))
    assert (wait.call, [waker.by for waker in wait.wakers]) == (POLLING_LOOP, ['on_stop'])
    assert wait.seconds is None


def test_a_loop_over_numbers_waits_for_what_it_looks_at_until_they_are_through() -> None:
    looks = 'for _ in range(50):\n    if not self.running:\n        {}\n    time.sleep(0.1)'
    for out in ('break', 'return'):
        wait = last_wait(looks.format(out))
        assert (wait.call, [waker.by for waker in wait.wakers]) == (POLLING_LOOP, ['on_stop'])
        assert isinstance(wait.seconds, Unknown)


@pytest.mark.parametrize(
    'work',
    [
        'for _ in range(3):\n    self.lines.get()',
        'for number in range(3):\n    if number == 2:\n        break\n    self.lines.get()',
        'rounds = 0\nwhile rounds < 3:\n    rounds += 1\n    self.lines.get()',
        loop('self.running', 'self.lines.get()', 'self.running = False'),
    ],
)
def test_a_loop_that_ends_by_itself_waits_in_its_rounds_alone(work: str) -> None:
    assert last_wait(work).call == 'Queue.get'
