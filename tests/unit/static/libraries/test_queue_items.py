"""Functions, events and futures that go through a queue to its consumer."""

from __future__ import annotations

import pytest

from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Spec

PROGRAM = """
import queue
import threading
import multiprocessing
from collections import deque
from concurrent.futures import Future
import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger

class Job:
    def __init__(self):
        self.done = threading.Event()

class Desk(Node):
    def __init__(self):
        super().__init__('desk')
        self.jobs = {queue}
        self.count = 0
        self.create_service(Trigger, 'ask', self.on_ask)
        threading.Thread(target=self.work, daemon=True).start()
        {more}

    def add(self):
        self.count += 1

    def on_ask(self, request, response):
        {ask}
        return response

    def other(self):
        self.jobs.get()

    def work(self):
        while True:
            {work}

rclpy.init()
rclpy.spin(Desk())
"""
JOB = 'job = Job()\n        self.jobs.put(job)\n        job.done.wait()'
FUTURE = 'future = Future()\n        self.jobs.put((request, future))\n        future.result()'
SET_JOB = (
    'job = self.jobs.get()\n            if job is None:\n                break\n'
    '            job.done.set()'
)
SET_FUTURE = 'request, future = self.jobs.get()\n            future.set_result(request)'


def _unit(
    *, ask: str, work: str, queue: str = 'queue.Queue()', more: str = 'self.jobs.put(None)'
) -> Spec:
    (unit,) = scan_text(PROGRAM.format(queue=queue, ask=ask, work=work, more=more)).units
    return unit


def _wait(unit: Spec) -> Blocking:
    (on_ask,) = (each for each in unit.callbacks if each.name == 'on_ask')
    (wait,) = on_ask.blocking
    return wait


@pytest.mark.parametrize(('ask', 'work'), [(JOB, SET_JOB), (FUTURE, SET_FUTURE)])
@pytest.mark.parametrize('queue', ['queue.Queue()', 'queue.SimpleQueue()', 'queue.LifoQueue()'])
def test_who_takes_it_out_ends_the_wait(ask: str, work: str, queue: str) -> None:
    wait = _wait(_unit(ask=ask, work=work, queue=queue, more='pass'))
    assert ([waker.by for waker in wait.wakers], wait.escapes) == (['work'], None)


def test_a_last_item_that_is_none_changes_nothing() -> None:
    wait = _wait(_unit(ask=JOB, work=SET_JOB))
    assert ([waker.by for waker in wait.wakers], wait.escapes) == (['work'], None)


@pytest.mark.parametrize(
    ('queue', 'work', 'more'),
    [
        ('multiprocessing.Queue()', SET_JOB, 'pass'),  # others have copies
        ('queue.Queue()', 'pass', 'pass'),  # no known code takes anything
        ('queue.Queue()', SET_JOB, 'connect(self.jobs)'),
    ],
)
def test_whoever_is_not_in_sight_may_end_it(queue: str, work: str, more: str) -> None:
    assert _wait(_unit(ask=JOB, work=work, queue=queue, more=more)).escapes is not None


def test_who_gets_it_elsewhere_too_leaves_it_open() -> None:
    more = 'connect(job)'
    ask = JOB.replace('job.done.wait()', f'{more}\n        job.done.wait()')
    assert _wait(_unit(ask=ask, work=SET_JOB)).escapes is not None


@pytest.mark.parametrize(
    ('queue', 'put', 'work'),
    [
        ('queue.Queue()', 'put', 'self.jobs.get()()'),
        ('queue.Queue()', 'put', 'job, text = self.jobs.get()\n            job()'),
        ('deque()', 'append', 'self.jobs.popleft()()'),
        ('[]', 'append', 'self.jobs.pop(0)()'),
    ],
)
def test_a_function_is_called_by_who_takes_it_out(queue: str, put: str, work: str) -> None:
    item = '(self.add, 1)' if 'text' in work else 'self.add'
    unit = _unit(ask=f'self.jobs.{put}({item})', work=work, queue=queue, more='pass')
    (thread,) = unit.activities
    assert 'Desk.count' in [write.name for write in thread.writes]
