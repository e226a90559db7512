"""
What is asked before a wait, or in a loop, does not make the wait vanish.

The ways below were run on rclpy 7.1.6: where the partner is in the group of the waiter, nothing
goes on, and where it has a group of its own, every run of the waiter ends.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.shapes.variants import node, said_of_waits

_ASKS_A_SERVICE = """
self.client = self.create_client(Trigger, 'go', callback_group=self.{group})
self.create_service(Trigger, 'go', self.serve, callback_group=MutuallyExclusiveCallbackGroup())
self.create_timer(0.2, self.tick, callback_group=self.own)
"""
_HAS = """
self.answer = {made}
self.pool = concurrent.futures.ThreadPoolExecutor(2)
self.create_timer(0.2, self.tick, callback_group=self.own)
self.create_timer(0.3, self.tock, callback_group=self.{group})
"""
_OF_RCLPY = _HAS.replace('{made}', 'Future()')
_OF_A_POOL = _HAS.replace('{made}', 'concurrent.futures.Future()')
_EVENT = _HAS.replace('{made}', 'threading.Event()')
_SETS = """
def tock(self):
    if not self.answer.done():
        self.answer.set_result(1)
"""
_WORKS = """
def work(self):
    self.answer.wait()

def tock(self):
    self.answer.set()
"""
_POLL = """
def tick(self):
    while not self.answer.done():
        time.sleep(0.01)
"""

WAYS = {
    'await behind a test': (
        _OF_RCLPY,
        """
async def tick(self):
    if not self.answer.done():
        await self.answer
"""
        + _SETS,
        'CC104',
    ),
    'await where it is not done': (
        _OF_RCLPY,
        """
async def tick(self):
    if self.answer.done():
        return
    await self.answer
"""
        + _SETS,
        'CC104',
    ),
    'asked for the log': (
        _OF_RCLPY,
        """
async def tick(self):
    self.get_logger().info(f'{self.answer.done()}')
    await self.answer
"""
        + _SETS,
        'CC104',
    ),
    'result behind a test': (
        _OF_A_POOL,
        """
def tick(self):
    if not self.answer.done():
        self.answer.result()
"""
        + _SETS,
        'CC101',
    ),
    'rclpy future in a loop': (_OF_RCLPY, _POLL + _SETS, 'CC101'),
    'future of a pool in a loop': (_OF_A_POOL, _POLL + _SETS, 'CC101'),
    'done or at work': (
        _OF_A_POOL,
        """
def tick(self):
    while not self.answer.done() and not self.answer.running():
        time.sleep(0.01)
"""
        + _SETS,
        'CC101',
    ),
    'name of the answer': (
        _ASKS_A_SERVICE,
        """
def tick(self):
    future = self.client.call_async(Trigger.Request())
    ready = future.done()
    while not ready:
        time.sleep(0.01)
        ready = future.done()
""",
        'CC101',
    ),
    'left inside': (
        _ASKS_A_SERVICE,
        """
def tick(self):
    future = self.client.call_async(Trigger.Request())
    while True:
        if future.done():
            break
        time.sleep(0.01)
""",
        'CC101',
    ),
    'done or cancelled': (
        _ASKS_A_SERVICE,
        """
def tick(self):
    future = self.client.call_async(Trigger.Request())
    while rclpy.ok() and not (future.done() or future.cancelled()):
        time.sleep(0.01)
""",
        'CC101',
    ),
    'asked by a function': (
        _ASKS_A_SERVICE,
        """
def tick(self):
    future = self.client.call_async(Trigger.Request())
    while not self.is_there(future):
        time.sleep(0.01)

def is_there(self, future):
    return future.done()
""",
        'CC101',
    ),
    'thread alive': (
        _EVENT,
        """
def tick(self):
    worker = threading.Thread(target=self.work)
    worker.start()
    while worker.is_alive():
        time.sleep(0.01)
"""
        + _WORKS,
        'CC109',
    ),
    'thread alive, left inside': (
        _EVENT,
        """
def tick(self):
    worker = threading.Thread(target=self.work)
    worker.start()
    while True:
        time.sleep(0.01)
        if not worker.is_alive():
            break
"""
        + _WORKS,
        'CC109',
    ),
    'any thread alive': (
        _EVENT,
        """
def tick(self):
    workers = [threading.Thread(target=self.work) for _ in range(2)]
    for worker in workers:
        worker.start()
    while any(worker.is_alive() for worker in workers):
        time.sleep(0.01)
"""
        + _WORKS,
        'CC109',
    ),
    'joined where it is alive': (
        _EVENT,
        """
def tick(self):
    worker = threading.Thread(target=self.work)
    worker.start()
    if worker.is_alive():
        worker.join()
"""
        + _WORKS,
        'CC109',
    ),
    'job done': (
        _EVENT,
        """
def tick(self):
    job = self.pool.submit(self.work)
    while not job.done():
        time.sleep(0.01)
"""
        + _WORKS,
        'CC109',
    ),
    'job at work': (
        _EVENT,
        """
def tick(self):
    job = self.pool.submit(self.work)
    while job.running():
        time.sleep(0.01)
"""
        + _WORKS,
        'CC109',
    ),
}


@pytest.mark.parametrize(('init', 'methods', 'code'), WAYS.values(), ids=list(WAYS))
def test_who_ends_it_cannot_run(init: str, methods: str, code: str, tmp_path: Path) -> None:
    assert said_of_waits(node(init.format(group='own'), methods), tmp_path) == code


@pytest.mark.parametrize(('init', 'methods', 'code'), WAYS.values(), ids=list(WAYS))
def test_who_ends_it_has_a_group_of_its_own(
    init: str, methods: str, code: str, tmp_path: Path
) -> None:
    del code
    assert said_of_waits(node(init.format(group='other'), methods), tmp_path) == 'clean'


def test_whether_it_is_worked_at_by_then_is_not_decided(tmp_path: Path) -> None:
    waits = """
def tick(self):
    job = self.pool.submit(self.work)
    while not job.running():
        time.sleep(0.001)
"""
    text = node(_EVENT.format(group='other'), waits + _WORKS)
    assert said_of_waits(text, tmp_path) == 'undecided'


BEHIND = {
    'taken when it is done': """
def tick(self):
    if self.answer.done():
        self.answer.result()
""",
    'given up before': """
def tick(self):
    if not self.answer.done() or not rclpy.ok():
        return
    self.answer.result()
""",
    'one behind the other': """
def tick(self):
    return self.answer.done() and self.answer.result()
""",
    'one or the other': """
def tick(self):
    return self.answer.result() if self.answer.done() else None
""",
    'said otherwise': """
def tick(self):
    if self.answer.done() is False:
        return
    self.answer.result()
""",
    'where all ways lead there': """
def tick(self):
    if not self.answer.done():
        if rclpy.ok():
            return
        raise RuntimeError
    self.answer.result()
""",
    'picked out': """
def tick(self):
    for each in [one for one in (self.answer,) if one.done()]:
        each.result()
""",
}


@pytest.mark.parametrize('methods', BEHIND.values(), ids=list(BEHIND))
def test_the_result_of_what_is_done_does_not_wait(methods: str, tmp_path: Path) -> None:
    text = node(_OF_A_POOL.format(group='own'), methods + _SETS)
    assert said_of_waits(text, tmp_path) == 'clean'


FORGOTTEN = {
    'on one of two ways': """
def tick(self):
    if self.answer.done():
        time.sleep(0.01)
    self.answer.result()
""",
    'where an error came first': """
def tick(self):
    try:
        rclpy.ok()
        if not self.answer.done():
            return
    except ValueError:
        pass
    self.answer.result()
""",
}


@pytest.mark.parametrize('methods', FORGOTTEN.values(), ids=list(FORGOTTEN))
def test_what_was_found_on_another_way_counts_for_nothing(methods: str, tmp_path: Path) -> None:
    text = node(_OF_A_POOL.format(group='own'), methods + _SETS)
    assert said_of_waits(text, tmp_path) == 'CC101'


def test_a_loop_that_a_clock_ends_too_is_no_wait_for_ever(tmp_path: Path) -> None:
    waits = """
def tick(self):
    end = time.monotonic() + 1.0
    while not self.answer.done() and time.monotonic() < end:
        time.sleep(0.01)
"""
    text = node(_OF_A_POOL.format(group='other'), waits + _SETS)
    assert said_of_waits(text, tmp_path) == 'clean'
