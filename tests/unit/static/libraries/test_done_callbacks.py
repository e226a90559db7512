"""Which thread runs a done-callback, and with which locks held."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import threading
import concurrent.futures
import rclpy
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String
from std_srvs.srv import Trigger

class Table(Node):
    def __init__(self):
        super().__init__('table')
        self._lock = threading.Lock()
        self._pool = concurrent.futures.ThreadPoolExecutor()
        self._trigger = self.create_client(Trigger, 'trigger')
        self._held = None
        self._queue = []
        self.create_subscription(String, 'free', self._on_free, 10)
        self.create_subscription(String, 'ask', self._on_ask, 10)

    def _on_ask(self, msg):
        ASK

    def _on_free(self, msg):
        FREE

    def _done(self, future):
        with self._lock:
            self._last = future.result()

rclpy.init()
executor = rclpy.executors.MultiThreadedExecutor(2)
executor.add_node(Table())
executor.spin()
"""
TWICE, ONCE = [('_lock',)], []
HELD = 'with self._lock:\n            '
GIVES = 'future = Future(); future.add_done_callback(self._done); '
SETS = 'self._held.set_result(msg)'


def taken_twice(ask: str, free: str = 'pass') -> list[tuple[str, ...]]:
    """What is held where a callback takes the lock that it holds."""
    found = scan_text(PROGRAM.replace('ASK', ask).replace('FREE', free))
    (unit,) = found.units
    made = [each for each in unit.callbacks if each.name in ('_on_ask', '_on_free')]
    return [act.held for each in made for act in each.locks if act.held]


@pytest.mark.parametrize(
    ('ask', 'free', 'held'),
    [
        (GIVES + 'self._held = future', HELD + SETS, TWICE),
        (GIVES + 'self._held = future', SETS, ONCE),
        (GIVES + 'self._held = future', HELD + 'self._held.set_exception(KeyError())', TWICE),
        (GIVES + 'self._held = future', HELD + 'self._held.cancel()', TWICE),
        (GIVES + 'self._queue.append(future)', HELD + 'self._queue.pop().set_result(msg)', TWICE),
        ('self._held = future = Future(); future.add_done_callback(print)', HELD + SETS, ONCE),
        (GIVES.replace('()', '(executor=self.executor)', 1) + 'self._held = future', SETS, ONCE),
        (
            GIVES.replace('()', '(executor=self.executor)', 1) + 'self._held = future',
            HELD + SETS,
            ONCE,
        ),
    ],
)
def test_who_completes_a_future_runs_what_was_added(
    ask: str, free: str, held: list[tuple[str, ...]]
) -> None:
    assert taken_twice(ask, free) == held


@pytest.mark.parametrize(
    ('made', 'held'),
    [
        ('Future()', ONCE),
        ('Future(); future.set_result(1)', TWICE),
        ('Future(); msg.data and future.set_result(1)', TWICE),
        ('concurrent.futures.Future()', ONCE),
        ('concurrent.futures.Future(); future.set_result(1)', TWICE),
        ('self._pool.submit(print)', TWICE),  # it may have ended by then
        ('self._trigger.call_async(Trigger.Request())', ONCE),
        ('self._trigger.call_async(Trigger.Request()); future.cancel()', TWICE),
    ],
)
def test_what_is_added_to_a_future_that_is_done_runs_at_once(
    made: str, held: list[tuple[str, ...]]
) -> None:
    assert taken_twice(f'{HELD}future = {made}; future.add_done_callback(self._done)') == held


def test_an_answer_that_is_cancelled_has_no_executor_yet() -> None:
    asks = 'future = self._trigger.call_async(Trigger.Request()); '
    adds = 'future.add_done_callback(self._done)\n        '
    assert taken_twice(asks + adds + HELD + 'future.cancel()') == TWICE
