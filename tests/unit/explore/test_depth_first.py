"""A depth-first search runs each order once, up to the order of independent steps."""

from __future__ import annotations

import itertools
from collections.abc import Container, Iterator, Mapping, Sequence
from typing import Any

import pytest

from ros2cc_extract.explore.depth_first import Dependence, Search, Step, dependence_of, search
from ros2cc_extract.explore.exploring import Budget, Exploration
from ros2cc_extract.explore.watching import Process, Seen
from ros2cc_extract.extract.static.api import scan_text

A, B, C = 'a (timer)', 'b (/b)', 'c (/c)'
READ, WRITE, OTHER = 'x.py:1 read A.n', 'x.py:2 write A.n', 'x.py:3 write A.m'
LOCK = 'x.py:4 wait lock'
Program = Mapping[str, Sequence[str]]


class Simulated:
    """Activities with their steps; the chosen one goes on as long as it can."""

    def __init__(self, program: Program, strays_in: Container[int] = ()) -> None:
        self.program = program
        self.strays_in = strays_in
        self.orders: list[tuple[Step, ...]] = []

    def run(self, rows: Sequence[Any]) -> Process:
        (row,) = rows
        left = {f'{label}#1': ['begin', *steps] for label, steps in self.program.items()}
        if len(self.orders) + 1 in self.strays_in:
            left.pop(next(iter(left)))
        prefix = [tuple(each) for each in row['choices']]
        seen, last = Seen(row, begins=1), ''
        while any(left.values()) and len(seen.choices) < row['steps']:
            ready = [(key, steps[0]) for key, steps in sorted(left.items()) if steps]
            due = prefix[len(seen.choices)] if len(seen.choices) < len(prefix) else None
            if due is not None and due not in ready:
                break
            chosen = due or next((each for each in ready if each[0] == last), ready[0])
            left[chosen[0]].pop(0)
            last = chosen[0]
            seen.choosable.append(ready)
            seen.choices.append(chosen)
        self.orders.append(tuple(seen.choices))
        return Process(schedules=[seen])


def searched(
    program: Program, groups: Mapping[str, str] | None = None, steps: int = 50, **more: Any
) -> tuple[Search, Simulated, Exploration]:
    simulated = Simulated(program, more.get('strays_in', ()))
    found, so_far = Search(steps, frozenset(program)), Exploration()
    dependence = Dependence(groups or {}, ('lock',))
    search(simulated.run, dependence, found, Budget(schedules=more.get('most', 500)), so_far)
    return found, simulated, so_far


def classes(program: Program, dependence: Dependence) -> set[frozenset[tuple[Step, int]]]:
    """All orders by brute force, each as which dependent steps come before which."""
    keys = [f'{label}#1' for label, steps in program.items() for _ in ('begin', *steps)]
    return {
        as_class(tuple(order), dependence)
        for keyed in set(itertools.permutations(keys))
        for order in [list(steps_of(keyed, program))]
    }


def steps_of(keys: Sequence[str], program: Program) -> Iterator[Step]:
    left = {f'{label}#1': ['begin', *steps] for label, steps in program.items()}
    for key in keys:
        yield key, left[key].pop(0)


def as_class(order: Sequence[Step], dependence: Dependence) -> Any:
    return frozenset(
        (one, other)
        for one, other in itertools.combinations(order, 2)
        if dependence.depend(one, other)
    )


@pytest.mark.parametrize(
    'program',
    [
        {A: [READ, WRITE], B: [READ, WRITE]},
        {A: [OTHER], B: [READ, WRITE]},
        {A: [LOCK, WRITE], B: [LOCK, READ]},
        {A: [WRITE], B: [READ], C: [READ]},
        {A: [], B: [], C: []},
    ],
)
def test_each_order_is_run_once_up_to_independent_steps(program: Program) -> None:
    groups = {'a': 'other', 'b': 'one', 'c': 'one'}
    dependence = Dependence(groups, ('lock',))
    found, simulated, _ = searched(program, groups)
    run = [as_class(each, dependence) for each in simulated.orders]
    assert set(run) == classes(program, dependence)
    assert found.distinct == len(set(run))
    assert found.is_over and found.words.startswith(f'complete: all {found.distinct} orders')


def test_what_is_cut_says_how_far_it_went() -> None:
    found, _, so_far = searched({A: [READ, WRITE], B: [READ, WRITE]}, steps=3)
    assert found.words.startswith('complete: all ') and ' of the first 3 steps' in found.words
    assert so_far.why_ended == 'there are no other orders'


def test_a_budget_leaves_it_incomplete() -> None:
    found, _, so_far = searched({A: [READ, WRITE], B: [READ, WRITE]}, most=2)
    assert found.words.startswith('not complete: 2 orders')
    assert so_far.why_ended == 'all schedules of the budget were run'


def test_a_program_that_does_not_do_the_same_again_is_never_complete() -> None:
    found, _, _ = searched({A: [READ, WRITE], B: [READ, WRITE]}, strays_in=range(2, 500))
    assert found.strayed
    assert f'did not repeat {found.strayed} of them' in found.words
    assert found.words.startswith('not complete')


@pytest.mark.parametrize('late_in', [{1}, {2}, {3, 4}])
def test_what_was_late_once_is_waited_for_in_another_run(late_in: set[int]) -> None:
    program = {A: [READ, WRITE], B: [READ, WRITE]}
    found, simulated, _ = searched(program, strays_in=late_in)
    dependence = Dependence({}, ('lock',))
    whole = [each for each in simulated.orders if len(each) == 6]
    assert {as_class(each, dependence) for each in whole} == classes(program, dependence)
    assert found.words.startswith('complete')


def test_a_callback_that_never_begins_leaves_it_incomplete() -> None:
    found, simulated, _ = searched({A: [READ], B: [READ]}, strays_in=range(1, 500))
    assert found.words == f'not complete: 1 orders were run, and {A} did not begin'
    assert len(simulated.orders) == 4


NODE = """\
import threading
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import String

class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.lock = threading.Lock()
        self.create_timer(1.0, self.first)
        self.create_subscription(String, 'stop', self.second, 1)
        self.create_subscription(
            String, 'go', self.third, 1, callback_group=MutuallyExclusiveCallbackGroup()
        )

    def first(self):
        with self.lock:
            pass

    def second(self, msg):
        pass

    def third(self, msg):
        pass

rclpy.init()
executor = MultiThreadedExecutor()
executor.add_node(Arm())
executor.spin()
"""


def test_groups_and_locks_come_from_the_source() -> None:
    found = dependence_of(scan_text(NODE).units)
    timer, stop, go = 'Arm.first (timer)', 'Arm.second (/stop)', 'Arm.third (/go)'
    groups = [found.groups[f'Arm.{name}'] for name in ('first', 'second', 'third')]
    assert groups[0] == groups[1] != groups[2]
    assert found.depend((f'{timer}#1', 'begin'), (f'{stop}#1', 'begin'))
    assert not found.depend((f'{timer}#1', 'begin'), (f'{go}#1', 'begin'))
    assert found.depend((f'{timer}#1', 'begin'), ('Unknown (/go)#1', 'begin'))
    assert set(found.locks) == {'lock'}
    assert found.depend(('a#1', 'x.py:1 wait lock'), ('b#1', 'x.py:9 wait lock'))
    assert not found.depend(('a#1', 'x.py:1 wait lock'), ('b#1', 'x.py:9 write A.n'))
    assert found.depend(('a#1', 'x.py:1 wait event'), ('b#1', 'x.py:9 write A.n'))
