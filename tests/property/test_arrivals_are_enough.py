"""
Claims on ends that hold with one arrival for each callback hold with three.

A model of one arrival is asked, and then only who needs more runs gets them. Small programs that
wait for queues, semaphores and events, of which some callbacks run once, are asked both ways.
"""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.spec.close import close
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

STEPS = (
    'self.jobs.put(1)',
    'self.jobs.get()',
    'self.answers.put(1)',
    'self.answers.get()',
    'self.permits.release()',
    'self.permits.acquire()',
    'self.ready.set()',
    'self.ready.wait()',
)
GROUPS = ('MutuallyExclusiveCallbackGroup()', 'self.one', 'ReentrantCallbackGroup()')
EXECUTORS = (
    'SingleThreadedExecutor()',
    'MultiThreadedExecutor(num_threads=2)',
    'MultiThreadedExecutor(num_threads=4)',
)
PROGRAM = """\
import queue
import threading

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node


class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.jobs = queue.Queue()
        self.answers = queue.Queue()
        self.permits = threading.Semaphore(0)
        self.ready = threading.Event()
        self.one = MutuallyExclusiveCallbackGroup()
{timers}
{functions}

rclpy.init()
executor = {executor}
executor.add_node(Arm())
executor.spin()
"""


def program(seed: int) -> str:
    draw = random.Random(seed)
    timers, functions = [], []
    for number in range(draw.randint(2, 3)):
        group = draw.choices(GROUPS, (3, 1, 1))[0]
        timers.append(
            f'        self.timer_{number} = self.create_timer('
            f'0.1, self.tick_{number}, callback_group={group})'
        )
        steps = [f'self.timer_{number}.cancel()'] if draw.random() < 0.35 else []
        steps += [draw.choice(STEPS) for _ in range(draw.randint(1, 3))]
        body = ''.join(f'        {step}\n' for step in steps)
        functions.append(f'    def tick_{number}(self):\n{body}')
    return PROGRAM.format(
        timers='\n'.join(timers), functions='\n'.join(functions), executor=draw.choice(EXECUTORS)
    )


def differing(seed: int) -> list[str]:
    """Who always ends with one arrival and not with three."""
    (unit,) = scan_text(program(seed)).units
    of_ends = frozenset({Family.PROGRESS})
    options = Options(profile=Profile.RCLPY, structural=False, families=of_ends)
    few = verify_unit(close(unit), options).results
    ending = {result.callbacks for result in few if result.verdict is Verdict.SATISFIED}
    if not ending:
        return []
    more = replace(options, max_cycle=3, limits=Limits(states=300_000))
    many = verify_unit(close(unit), more).results
    return [
        result.callbacks[0]
        for result in many
        if result.callbacks in ending
        and (result.verdict is Verdict.NOT_SATISFIED or result.in_doubt)
    ]


@pytest.mark.parametrize('seed', range(20))
def test_more_arrivals_refute_no_more(seed: int) -> None:
    assert differing(seed) == []


@pytest.mark.slow
@pytest.mark.parametrize('seed', range(20, 1000))
def test_more_arrivals_refute_no_more_in_many_programs(seed: int) -> None:
    assert differing(seed) == []
