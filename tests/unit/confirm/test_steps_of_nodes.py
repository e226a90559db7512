"""What the running node did, in words: in order, and without repetitions."""

from __future__ import annotations

from typing import Any

from ros2cc_extract.confirm.recorded_runs import MOST_STEPS, recorded_run
from ros2cc_extract.confirm.schedules import Point, Schedule

SCHEDULE = Schedule(
    code='CC101',
    path='node.py',
    line=12,
    message='',
    entry='node.py',
    function='main',
    points=(Point(file='node.py', first=12, last=12), Point(file='node.py', first=30, last=31)),
)


def row(what: str, at: float, thread: int = 70, **facts: Any) -> dict[str, Any]:
    return {'what': what, 'at': at, 'thread': thread, **facts}


def test_steps_are_told_by_seconds_and_threads() -> None:
    rows = [
        {'what': 'started', 'at': 4.0, 'process': 9},
        row('begin', 4.5, 72, name='_list_parameters_callback', of_program=False),
        row('begin', 5.0, name='ask'),
        row('reached', 5.25, point=0),
        row('begin', 5.5, 71, name='serve'),
        row('reached', 5.5, 71, point=1),
        row('raised', 5.75, 71, point=1, type='KeyError', text="'x'"),
        row('end', 6.0, 71, name='serve'),
    ]
    del rows[-2]['thread']
    assert recorded_run(SCHEDULE, rows) == (
        '  0.000 s  thread 1: ask begins',
        '  0.250 s  thread 1: stands at line 12',
        '  0.500 s  thread 2: serve begins',
        '  0.500 s  thread 2: stands at line 30',
        "  0.750 s  line 30 raises KeyError: 'x'",
        '  1.000 s  thread 2: serve ends',
    )


def test_what_repeats_itself_stands_for_its_first_and_its_last_time() -> None:
    ticks = [row(what, at, name='tick') for at in range(50) for what in ('begin', 'end')]
    stands = row('reached', 20.5, 71, point=0)
    rows = sorted([*ticks, stands], key=lambda each: each['at'])
    assert recorded_run(SCHEDULE, rows) == (
        '  0.000 s  thread 1: tick begins',
        '  0.000 s  thread 1: tick ends',
        ' 20.500 s  thread 2: stands at line 12',
        ' 49.000 s  thread 1: tick begins',
        ' 49.000 s  thread 1: tick ends',
    )


def test_only_the_last_steps_are_told() -> None:
    rows = [row('begin', at, name=f'of_{at}') for at in range(40)]
    run = recorded_run(SCHEDULE, rows)
    assert (len(run), run[-1]) == (MOST_STEPS, ' 39.000 s  thread 1: of_39 begins')


def test_rows_that_are_none_of_ours_are_left_out() -> None:
    rows = [{'what': 'begin', 'at': 0.0}, row('reached', 1.0, point=7), {'what': [], 'at': 2}]
    assert recorded_run(SCHEDULE, rows) == ()
