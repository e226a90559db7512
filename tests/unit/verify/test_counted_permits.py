"""Waits that end by themselves so often, and then never: decided where runs use them up."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.slices import narrowing
from ros2cc_extract.verify.unit import verify_unit

PROGRAM = """\
import queue
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node


class Store(Node):
    def __init__(self):
        super().__init__('store')
        self.one = MutuallyExclusiveCallbackGroup()
        self.other = MutuallyExclusiveCallbackGroup()
        self.stock = {made}
        self.create_timer(0.1, self.take, callback_group=self.one)
        self.create_timer(0.1, self.give, callback_group=self.{group})

    def take(self):
        self.stock.{take}

    def give(self):
        self.stock.{give}


def main():
    rclpy.init()
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(Store())
    executor.spin()
"""
SEMAPHORE = {'made': 'threading.Semaphore(3)', 'take': 'acquire()', 'give': 'release()'}
QUEUE = {'made': 'queue.Queue(maxsize=2)', 'take': 'put(1)', 'give': 'get()'}


def ends(text: str) -> dict[str, tuple[Verdict, tuple[str, ...]]]:
    (unit,) = scan_text(text).units
    families = frozenset({Family.PROGRESS})
    options = Options(profile=Profile.RCLPY, structural=False, families=families)
    results = verify_unit(close(unit), options).results
    return {result.callbacks[0]: (result.verdict, result.repeated) for result in results}


@pytest.mark.parametrize('kind', [SEMAPHORE, QUEUE])
def test_who_keeps_the_giver_out_uses_up_what_there_was(kind: dict[str, str]) -> None:
    verdict, repeated = ends(PROGRAM.format(group='one', **kind))['take']
    assert verdict is Verdict.NOT_SATISFIED
    assert 'take' in repeated


@pytest.mark.parametrize('kind', [SEMAPHORE, QUEUE])
def test_a_giver_of_another_group_ends_every_wait(kind: dict[str, str]) -> None:
    assert ends(PROGRAM.format(group='other', **kind))['take'][0] is not Verdict.NOT_SATISFIED


def test_more_than_models_count_stays_undecided() -> None:
    text = PROGRAM.format(group='one', **{**SEMAPHORE, 'made': 'threading.Semaphore(90)'})
    assert ends(text)['take'][0] is Verdict.UNDECIDED


LOOP = """for _ in range(2):
            self.stock.acquire()"""


def test_rounds_of_a_loop_are_counted() -> None:
    text = PROGRAM.format(group='one', **{**SEMAPHORE, 'take': 'acquire()'})
    assert ends(text.replace('self.stock.acquire()', LOOP))['take'][0] is Verdict.NOT_SATISFIED


def test_rounds_in_which_more_happens_are_not_counted() -> None:
    """In which order the rounds take and give no model has."""
    text = PROGRAM.format(group='one', **SEMAPHORE)
    body = f'{LOOP}\n            self.stock.release()'
    assert ends(text.replace('self.stock.acquire()', body))['take'][0] is Verdict.UNDECIDED


JOINED = """def take(self):
        worker = threading.Thread(target=self.work)
        worker.start()
        worker.join()

    def work(self):
        self.stock.acquire()"""


def test_each_run_waits_for_the_thread_that_it_starts() -> None:
    text = PROGRAM.format(group='one', **SEMAPHORE)
    text = text.replace('def take(self):\n        self.stock.acquire()', JOINED)
    assert ends(text)['take'][0] is Verdict.NOT_SATISFIED


def test_runs_that_wait_for_one_lock_come_beside_those_that_use_it_up() -> None:
    """One waits under the lock, two fill the threads; the first run has used up the permit."""
    text = PROGRAM.format(group='other', **{**SEMAPHORE, 'made': 'threading.Semaphore(1)'})
    text = text.replace(
        'self.one = Mutually', 'self.lock = threading.Lock()\n        self.one = Re'
    )
    text = text.replace('ReExclusive', 'Reentrant')
    text = text.replace(
        'self.stock.acquire()', 'with self.lock:\n            self.stock.acquire()'
    )
    assert ends(text)['take'][0] is Verdict.NOT_SATISFIED


def test_a_large_unit_in_which_a_thread_waits_is_decided(monkeypatch: pytest.MonkeyPatch) -> None:
    """Slices are of callbacks: what runs beside the executor has none."""
    monkeypatch.setattr(narrowing, 'SMALL', 0)
    text = PROGRAM.format(group='one', **{**SEMAPHORE, 'made': 'threading.Semaphore(0)'})
    text = text.replace('def take(self):\n        self.stock.acquire()', JOINED)
    assert {verdict for verdict, _ in ends(text).values()} == {Verdict.NOT_SATISFIED}
