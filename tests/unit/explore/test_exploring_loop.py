"""Which schedules run in which process, when it ends, and what leads to a failure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

from ros2cc_extract.explore.exploring import (
    Budget,
    Exploration,
    Strategy,
    explore,
    founds_of,
    schedule_row,
)
from ros2cc_extract.explore.failures import Failure, Kind
from ros2cc_extract.explore.watching import Process, Seen

HANG = Failure(kind=Kind.HANG, file='arm.py', line=3, words='waits')


class Program:
    """Runs schedules as a process does; some of them fail."""

    def __init__(self, fails: Sequence[int] = (), failure: Failure = HANG) -> None:
        self.fails = fails
        self.failure = failure
        self.asked: list[list[int]] = []

    def run(self, rows: Sequence[Any]) -> Process:
        self.asked.append([row['number'] for row in rows])
        done = []
        for row in rows:
            failures = [self.failure] if row['number'] in self.fails else []
            done.append(Seen(row, failures=failures, begins=2))
            if failures and self.failure.kind is Kind.HANG:
                break
        return Process(schedules=done)


def explored(program: Program, schedules: int, **more: Any) -> Exploration:
    found = Exploration()
    explore(program.run, Strategy.PCT, 1, Budget(schedules=schedules, **more), found)
    return found


def test_one_process_of_four_runs_many_schedules() -> None:
    program = Program()
    found = explored(program, 25, a_process=10)
    assert [len(each) for each in program.asked] == [1, 10, 1, 1, 1, 10, 1]
    assert [number for each in program.asked for number in each] == list(range(1, 26))
    assert (found.done, found.begins, found.why_ended) == (25, 50, 'all schedules were run')


def test_after_a_hang_the_next_process_goes_on_with_the_next_schedule() -> None:
    program = Program(fails=[4])
    found = explored(program, 12, a_process=10)
    assert program.asked[:3] == [[1], list(range(2, 12)), [5]]
    assert [(each.number, each.times) for each in found.found] == [(4, 1)]


def test_the_same_hang_again_and_again_ends_it() -> None:
    found = explored(Program(fails=range(1, 100)), 90)
    assert found.why_ended == 'every process hangs at the same place: mend that first'
    assert (found.done, found.found[0].times) == (4, 4)


def test_it_may_end_with_the_first() -> None:
    lost = Failure(kind=Kind.LOST_UPDATE, file='arm.py', line=3, words='n')
    found = explored(Program(fails=[2], failure=lost), 90, only_first=True)
    assert found.why_ended == 'a failure was found'


def test_time_and_a_program_that_does_not_get_there_end_it() -> None:
    assert explored(Program(), 5, deadline=0.0).why_ended == 'the time is over'
    found = Exploration()
    explore(lambda rows: Process(), Strategy.RANDOM, 1, Budget(schedules=5), found)
    assert found.why_ended == 'the program did not get to a schedule'


def test_what_was_seen_until_ctrl_c_is_kept() -> None:
    seen = Seen({'number': 1, 'policy': 'pct'}, failures=[HANG])
    found = Exploration()
    with pytest.raises(KeyboardInterrupt):
        explore(
            lambda rows: Process(schedules=[seen], interrupted=True),
            *(Strategy.PCT, 1, Budget(schedules=5), found),
        )
    assert [each.failure for each in found.found] == [HANG]


def test_schedules_differ_by_seed_and_depth() -> None:
    rows = [schedule_row(Strategy.MIXED, 7, number, 30) for number in range(1, 7)]
    assert [row['seed'] for row in rows] == [f'7/{number}' for number in range(1, 7)]
    assert [row['policy'] for row in rows] == ['pct', 'random'] * 3
    assert {row['depth'] for row in rows if row['policy'] == 'pct'} == {2, 3, 4}


@pytest.mark.parametrize(('step', 'tail'), [(0, 'cd'), (1, 'a'), (2, 'b'), (3, 'bc')])
def test_what_leads_there_begins_where_nobody_was_at_work(step: int, tail: str) -> None:
    failure = Failure(kind=Kind.LOST_UPDATE, file='', line=1, words='', step=step)
    choices = [(letter, 'begin') for letter in 'abcd']
    rounds = [0, 1, 2] if not step else [0, 1]
    seen = Seen({'number': 1, 'policy': 'pct'}, failures=[failure], choices=choices, rounds=rounds)
    (found,) = founds_of(seen)
    assert ''.join(key for key, _ in found.tail) == tail
    assert len(found.choices) == (step or 4)


def test_an_exception_is_told_when_somebody_else_may_have_begun() -> None:
    failure = Failure(kind=Kind.EXCEPTION, file='', line=1, words='', step=4)
    choices = [(letter, 'begin') for letter in 'abcd']
    seen = Seen({'number': 1}, failures=[failure], choices=choices, rounds=[0, 1, 3])
    (found,) = founds_of(seen)
    assert ''.join(key for key, _ in found.tail) == 'bcd'
