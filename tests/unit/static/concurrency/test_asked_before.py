"""``if not q.empty(): q.get()``: a wait only where another taker may come between."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text

PROGRAM = """\
import queue
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.one = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.stock = queue.Queue()
        self.create_timer(0.1, self.first, callback_group=self.one)
        self.create_timer(0.1, self.second, callback_group=self.{group})
        self.create_timer(0.1, self.fill)
        {more}

    {kind} first(self):
        if not self.stock.empty():
            {between}
            self.stock.get()

    def second(self):
        if not self.stock.empty():
            self.stock.get()

    def fill(self):
        self.stock.put(1)

    def take(self):
        self.stock.get_nowait()


def main():
    rclpy.init()
    executor = {executor}
    executor.add_node(Store())
    executor.spin()
"""
SINGLE, POOL = 'SingleThreadedExecutor()', 'MultiThreadedExecutor(num_threads=2)'
NOT_BETWEEN = {'kind': 'def', 'between': 'pass', 'more': 'pass'}
THREAD = {'more': 'threading.Thread(target=self.take).start()'}
AWAIT = {'kind': 'async def', 'between': 'await self.executor.create_task(self.second)'}
SPIN = {'between': 'rclpy.spin_once(self)'}


def waits_in_get(executor: str, group: str, **how: str) -> bool:
    words = {**NOT_BETWEEN, **how}
    (unit,) = scan_text(PROGRAM.format(executor=executor, group=group, **words)).units
    first = next(c for c in unit.callbacks if (c.function or '').endswith('first'))
    return any(block.call == 'Queue.get' for block in first.blocking)


PLACES = [(SINGLE, 'other'), (SINGLE, 'one'), (POOL, 'one')]


@pytest.mark.parametrize(('executor', 'group'), PLACES)
def test_who_cannot_come_between_takes_nothing(executor: str, group: str) -> None:
    assert not waits_in_get(executor, group)


def test_a_taker_of_another_group_may_come_between() -> None:
    assert waits_in_get(POOL, 'other')


@pytest.mark.parametrize('how', [THREAD, AWAIT, SPIN])
def test_threads_awaits_and_spins_let_others_between(how: dict[str, str]) -> None:
    assert waits_in_get(SINGLE, 'other', **how)


def is_full(program: str) -> str:
    """The same of a queue of two that is asked whether it is full."""
    bounded = program.replace('queue.Queue()', 'queue.Queue(2)')
    return bounded.replace('if not self.stock.empty()', 'if self.stock.full()')


def waits_of_first(executor: str, group: str, program: str) -> list[str]:
    text = program.format(executor=executor, group=group, **NOT_BETWEEN)
    (unit,) = scan_text(text).units
    first = next(c for c in unit.callbacks if (c.function or '').endswith('first'))
    return [block.call for block in first.blocking]


def test_what_is_full_holds_something() -> None:
    assert waits_of_first(SINGLE, 'one', is_full(PROGRAM)) == []
    other = is_full(PROGRAM).replace('if self.stock.full()', 'if not self.stock.full()')
    assert waits_of_first(SINGLE, 'one', other) == ['Queue.get']


def test_another_taker_may_come_between() -> None:
    assert waits_of_first(POOL, 'other', is_full(PROGRAM)) == ['Queue.get']
