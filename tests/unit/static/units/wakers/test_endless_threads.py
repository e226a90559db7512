"""Threads that work in a loop which nothing ends: no wait of theirs, and no end for others."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import OUTSIDE
from ros2cc_extract.spec.model import Activity, Spec

PROGRAM = """
import threading
import time
import rclpy
from rclpy.node import Node
from std_msgs.msg import Empty

class Lamp(Node):
    def __init__(self):
        super().__init__('lamp')
        self.running = True
        self.stop = threading.Event()
        self.go = threading.Event()
        self.seen = threading.Event()
        self.light = self.create_publisher(Empty, 'light', 10)
        self.create_timer(1.0, self.tick)
        self.work = threading.Thread(target=self.blink, daemon=True)
        self.work.start()

    def tick(self):
        {tick}

    def blink(self):
        while {test}:
            {body}
            time.sleep(0.1)
        {behind}

def main():
    rclpy.init()
    node = Lamp()
    rclpy.spin(node)
    {end}
"""
PUBLISH = 'self.light.publish(Empty())'


def _unit(
    test: str,
    tick: str = 'pass',
    body: str = PUBLISH,
    behind: str = 'pass',
    end: str = 'rclpy.shutdown()',
) -> Spec:
    (unit,) = scan_text(
        PROGRAM.format(test=test, tick=tick, body=body, behind=behind, end=end)
    ).units
    return unit


TESTS = ['self.running', 'not self.stop.is_set()']


def _calls(thread: Activity) -> list[str]:
    return [block.call for block in thread.blocking if block.call != 'time.sleep']


@pytest.mark.parametrize('test', TESTS)
def test_a_loop_that_nothing_ends_is_no_wait_of_its_thread(test: str) -> None:
    (thread,) = _unit(test).activities
    assert (_calls(thread), thread.loops) == ([], True)


@pytest.mark.parametrize('test', [*TESTS, 'True'])
def test_what_its_rounds_do_comes_before_its_end(test: str) -> None:
    (thread,) = _unit(test, 'self.seen.wait()', 'self.go.wait(); self.seen.set()').activities
    assert (_calls(thread), thread.loops) == (['Event.wait'], True)


@pytest.mark.parametrize('test', TESTS)
def test_a_loop_that_the_callback_ends_is_behind_what_its_rounds_wait_for(test: str) -> None:
    clear = 'self.running = False; self.stop.set(); self.seen.wait()'
    unit = _unit(test, clear, 'self.go.wait(); self.seen.set()')
    (thread,) = unit.activities
    assert _calls(thread) == ['Event.wait', 'working loop']
    (callback,) = (each for each in unit.callbacks if each.name == 'tick')
    assert [waker.after for block in callback.blocking for waker in block.wakers] == [1]


@pytest.mark.parametrize(
    ('tick', 'behind'), [('self.work.join()', 'pass'), ('self.stop.wait()', 'self.stop.set()')]
)
def test_who_waits_for_what_is_behind_the_loop_waits_for_its_end(tick: str, behind: str) -> None:
    (thread,) = _unit('self.running', tick, behind=behind).activities
    assert (_calls(thread), thread.loops) == (['working loop'], False)


def _join(unit: Spec) -> tuple[list[str], str | None]:
    (callback,) = (each for each in unit.callbacks if each.name == 'tick')
    (block,) = (each for each in callback.blocking if each.call == 'Thread.join')
    return [waker.by for waker in block.wakers], block.escapes and block.escapes.reason


def test_the_end_of_a_loop_that_nothing_can_end_never_comes() -> None:
    assert _join(_unit('True', 'self.work.join()', body='print(1)')) == ([], None)


@pytest.mark.parametrize(('test', 'body'), [('True', PUBLISH), ('rclpy.ok()', 'print(1)')])
def test_a_loop_that_the_end_of_rclpy_ends_may_not_end_before(test: str, body: str) -> None:
    wakers, why = _join(_unit(test, 'self.work.join()', body=body))
    assert wakers == ['blink']
    assert why == 'the loop of the thread ends only by an error or with the program'


def test_a_flag_that_main_clears_behind_the_spin_ends_it_from_outside() -> None:
    (thread,) = _unit('self.running', end='node.running = False').activities
    (_, loop) = thread.blocking
    assert [waker.by for waker in loop.wakers] == [OUTSIDE]
