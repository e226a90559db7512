"""Waits that end by themselves so often, and then never: decided where runs use them up."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.unit import Options, verify_unit

PROGRAM = """\
import queue
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
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


def test_runs_of_a_loop_are_not_counted() -> None:
    """How often it goes round no model has."""
    text = PROGRAM.format(group='one', **SEMAPHORE)
    body = '        for _ in range(2):\n            self.stock.acquire()'
    text = text.replace('        self.stock.acquire()', body)
    assert ends(text)['take'][0] is Verdict.UNDECIDED
