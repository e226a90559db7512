"""A short run of the random programs that wait; ``make random-waits`` runs many."""

from __future__ import annotations

import ast
import os
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests.random_waits.kinds import KINDS
from tests.random_waits.programs import program
from tests.random_waits.recorded import Ran, add, load, unfinished
from tests.random_waits.suite import ENDS, FOUND, Tally, judge, judge_all, watch

#: They hang in different ways, and are judged within a second.
SEEDS = (30030, 30032, 30034)


def test_a_seed_gives_one_program() -> None:
    texts = [program(seed) for seed in range(50)]
    assert texts == [program(seed) for seed in range(50)]
    assert len(set(texts)) == 50
    for text in texts:
        ast.parse(text)


def test_every_kind_of_wait_is_drawn() -> None:
    texts = [program(seed) for seed in range(400)]
    ways = [
        kind.waits.format(f'{name}_0').splitlines()[-1].strip() for name, kind in KINDS.items()
    ]
    ways += ['.join()', 'run_coroutine_threadsafe', 'create_task', 'await task', 'for _ in range']
    ways += ['rclpy.spin_until_future_complete', 'self.executor.spin_until_future_complete']
    ways += ['.call(Trigger', 'await self.client', 'num_threads=3', 'group_2']
    assert [way for way in ways if not any(way in text for text in texts)] == []


def test_a_record_goes_on_where_it_was_cut(tmp_path: Path) -> None:
    record = tmp_path / 'record.jsonl'
    first = Ran(1, ('tick_0',))
    add(record, [first, Ran(2, ())])
    judged = replace(first, judged={'tick_0': FOUND})
    add(record, [judged])
    with record.open('a', encoding='utf-8') as stream:
        stream.write('{"seed": 3, "st')
    add(record, [Ran(2, ())])
    known = load(record)
    assert known == {1: judged, 2: Ran(2, ())}
    assert unfinished(range(4), known) == [0, 3]


def test_who_is_called_stuck_counts_after_a_disturbed_run() -> None:
    tally = Tally()
    for disturbed in (None, (), ('tick_0',)):
        tally.add(Ran(1, (), disturbed, {'tick_0': FOUND, 'tick_1': ENDS}))
    tally.add(Ran(2, ('tick_1',), None, {'tick_1': ENDS}))
    assert tally.missed == [(2, 'tick_1')]
    assert (tally.programs, tally.hung) == (4, 1)
    assert tally.disturbed == {
        'was not run again': 1,
        'did not hang': 1,
        'hung under a disturbed schedule': 1,
    }


@pytest.mark.live
def test_who_hangs_is_never_said_to_end() -> None:
    tally = Tally()
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    for seed, stuck in watch(python, SEEDS).items():
        tally.add(Ran(seed, tuple(stuck), judged=judge(program(seed))))
    assert tally.programs == len(SEEDS)
    assert tally.hung > 0
    assert tally.missed == []


def test_what_was_judged_for_one_distribution_holds_for_another(tmp_path: Path) -> None:
    one, other = tmp_path / 'one.jsonl', tmp_path / 'other.jsonl'
    add(one, [Ran(1, ('tick_0',), None, {'tick_0': FOUND}), Ran(2, ())])
    add(other, [Ran(1, ()), Ran(30030, ())])
    judge_all(other, range(40_000), 1, one)
    known = load(other)
    assert known[1] == Ran(1, (), None, {'tick_0': FOUND})
    assert known[30030].judged == judge(program(30030))
