"""Who would end a wait may be kept out while somebody waits, or the end may be for another one."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from tests.random_waits.suite import ENDS, FOUND, UNDECIDED, judge

PROGRAM = """\
import asyncio
import queue
import threading
import time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Waiter(Node):
    def __init__(self):
        super().__init__('waiter')
        self.own = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.given, self.never = threading.Event(), threading.Event()
        self.stock = queue.Queue()
        self.permits = threading.Semaphore(3)
        self.changed = threading.Condition()
        self.loop = asyncio.new_event_loop()
        threading.Thread(target=self.loop.run_forever, daemon=True).start()
        self.create_timer(0.1, self.tick_0, callback_group=self.own)
        self.create_timer(0.1, self.tick_1, callback_group=self.{group})

{bodies}

rclpy.init()
executor = MultiThreadedExecutor(num_threads=3)
executor.add_node(Waiter())
executor.spin()
"""
TASK = """
def tick_0(self):
    self.given.wait()

def tick_1(self):
    self.executor.create_task(self.work_0)

def work_0(self):
    self.given.set()
"""
LOOP = """
def tick_0(self):
    asyncio.run_coroutine_threadsafe(self.work_0(), self.loop).result()

def tick_1(self):
    asyncio.run_coroutine_threadsafe(self.work_1(), self.loop)

async def work_0(self):
    self.given.set()

async def work_1(self):
    {blocks}
"""
POLLS = """
def tick_0(self):
    asyncio.run_coroutine_threadsafe(self.work_0(), self.loop).result()

def tick_1(self):
    asyncio.run_coroutine_threadsafe(self.work_1(), self.loop).result()

async def work_0(self):
    self.arrived = False
    while not self.arrived:
        {rests}

async def work_1(self):
    self.arrived = True
"""
PERMITS = """
def tick_0(self):
    self.permits.acquire()
    {gives}

def tick_1(self):
    {takes}
    self.permits.release()
"""
STOCK = """
def tick_0(self):
    self.stock.get()

def tick_1(self):
    {}
    {}
"""
NOTIFIED = """
def tick_0(self):
    pass

def tick_1(self):
    task = self.executor.create_task(self.work_0)
    while not task.done():
        time.sleep(0.01)

def work_0(self):
    with self.changed:
        self.changed.notify_all()
    with self.changed:
        self.changed.wait()
"""
POLLED = """
def tick_0(self):
    pass

def tick_1(self):
    task = self.executor.create_task(self.work_0)
    while not task.done():
        time.sleep(0.01)

def work_0(self):
    {}
"""


def program(bodies: str, group: str = 'other') -> str:
    text = '\n'.join(f'    {line}'.rstrip() for line in bodies.strip().splitlines())
    return PROGRAM.format(bodies=text, group=group)


def perhaps(text: str, call: str, of: str = 'tick_0') -> list[bool]:
    """Of the wakers of a callback's wait, whether they come only perhaps."""
    (unit,) = scan_text(text).units
    first = next(c for c in unit.callbacks if (c.function or '').endswith(of))
    block = next(block for block in first.blocking if block.call == call)
    return [waker.conditional for waker in block.wakers]


@pytest.mark.parametrize(('group', 'is_kept_out'), [('own', True), ('other', False)])
def test_a_task_is_not_there_before_its_maker_ran(group: str, is_kept_out: bool) -> None:
    assert perhaps(program(TASK, group), 'Event.wait') == [is_kept_out]
    assert judge(program(TASK, group))['tick_0'] == (UNDECIDED if is_kept_out else ENDS)


@pytest.mark.parametrize(
    ('blocks', 'is_kept_out'),
    [('self.never.wait()', True), ('await asyncio.sleep(1)', False), ('time.sleep(1)', False)],
)
def test_a_coroutine_that_blocks_holds_the_loop(blocks: str, is_kept_out: bool) -> None:
    text = program(LOOP.replace('{blocks}', blocks))
    assert perhaps(text, 'Future.result') == [is_kept_out]


@pytest.mark.parametrize(
    ('rests', 'expected'),
    [('time.sleep(0.01)', UNDECIDED), ('await asyncio.sleep(0.01)', ENDS)],
)
def test_a_coroutine_that_looks_at_data_and_sleeps_holds_the_loop(
    rests: str, expected: str
) -> None:
    assert judge(program(POLLS.replace('{rests}', rests)))['tick_0'] == expected


@pytest.mark.parametrize(
    ('gives', 'takes', 'expected'),
    [
        ('self.permits.release()', 'self.permits.acquire()', None),
        ('pass', 'self.permits.acquire()', FOUND),
        (
            'if self.given.is_set():\n        self.permits.release()',
            'self.permits.acquire()',
            FOUND,
        ),
        (
            'if self.count_clients("go"):\n        self.permits.release()',
            'self.permits.acquire()',
            UNDECIDED,
        ),
        (
            'if self.count_clients("go"):\n        self.permits.release()\n'
            '    else:\n        self.permits.release()',
            'self.permits.acquire()',
            None,
        ),
    ],
)
def test_a_semaphore_is_a_lock_where_all_give_back_what_they_take(
    gives: str, takes: str, expected: str | None
) -> None:
    judged = judge(program(PERMITS.format(gives=gives, takes=takes)))
    assert (judged.get('tick_0'), judged.get('tick_1')) == (expected, expected)


@pytest.mark.parametrize(
    ('first', 'then', 'is_for_another'),
    [
        ('self.stock.put(1)', 'self.stock.get()', True),
        ('self.stock.get()', 'self.stock.put(1)', False),
        ('self.stock.put(1)', 'self.stock.qsize()', False),
    ],
)
def test_who_puts_in_may_take_it_out_again(first: str, then: str, is_for_another: bool) -> None:
    assert perhaps(program(STOCK.format(first, then)), 'Queue.get') == [is_for_another]


def test_ones_own_notify_before_a_wait_in_a_task_ends_nothing() -> None:
    assert judge(program(NOTIFIED))['work_0'] == UNDECIDED
    tells = '    with self.changed:\n        self.changed.notify_all()'
    heard = program(NOTIFIED.replace('    pass', tells))
    assert perhaps(heard, 'Condition.wait', 'work_0') == [False, True]


@pytest.mark.parametrize(
    ('does', 'expected'), [('time.sleep(0.1)', ENDS), ('self.never.wait()', FOUND)]
)
def test_the_end_of_a_task_ends_who_asks_for_it(does: str, expected: str) -> None:
    assert judge(program(POLLED.format(does)))['tick_1'] == expected
