"""
The reproduced bugs of ``tests/bugs`` run on real rclpy: each shows its symptom, its twin does not.

What is found in their sources is compared in ``tests/bugs/test_bugs.py``.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from side_by_side import PATIENCE_S, Program, RunForked

BUGS = Path(__file__).parents[1] / 'bugs'
SHORT_S, LONG_S = 2.5, 10.0
HOLDS_S = 0.4
Lines = list[str]


@dataclass(frozen=True)
class Bug:
    """
    A program, and what to look at.

    :param around: arguments of ``surroundings.surround``.
    :param awaited: patterns of lines; what shows the symptom is judged once they have come.
    :param shows: without it the symptom is that the lines awaited do not come.
    :param slowed: replacements in the source that make what it does last longer.
    """

    name: str
    around: dict[str, object]
    awaited: tuple[str, ...]
    shows: Callable[[Lines], bool] | None = None
    slowed: tuple[tuple[str, str], ...] = field(default=())

    def program(self, stem: str, seconds: float) -> Program:
        path = BUGS / f'{stem}.py'
        text = path.read_text(encoding='utf-8')
        for old, new in self.slowed:
            assert old in text, f'{stem} has changed'
            text = text.replace(old, new)
        is_bug = stem == self.name
        around = {**self.around, 'holds_s': PATIENCE_S if is_bug else HOLDS_S}
        return Program(
            name=stem,
            path=str(path),
            text=f'import surroundings\nsurroundings.surround(**{around!r})\n{text}',
            patience_s=seconds if is_bug and self.shows is None else PATIENCE_S,
            awaited=self.awaited,
        )

    def has_symptom(self, lines: Lines) -> bool:
        if self.shows is not None:
            return self.shows(lines)
        left = list(self.awaited)
        for line in lines:
            if left and re.fullmatch(left[0], line):
                del left[0]
        return bool(left)


def loses_parts(lines: Lines) -> bool:
    """At each of the last reports more parts had come than all reported; some are on their way."""
    begun = told = 0
    missing = []
    for line in lines:
        begun += line == 'begins on_part'
        report = re.fullmatch(r'.*counter\]: (\d+)', line)
        if report:
            told += int(report[1])
            missing.append(begun - told)
    return min(missing[-REPORTS:]) > ON_THEIR_WAY


def overlaps_execute(lines: Lines) -> bool:
    held = lines[lines.index('execute begins') : lines.index('execute ends')]
    return 'ends drift' in held


FAST_REPORTS = (('self.create_timer(1.0', 'self.create_timer(0.005'),)
SLOW_EXECUTE = (('= goal_handle.request.order', '= hold(goal_handle.request.order)'),)
PARTS, REPORTS, ON_THEIR_WAY = 2000, 20, 3
#: How often a callback has to run that does not hang.
ROUNDS = 30
REPRODUCED = [
    Bug('a1_nested_spin', {'watch': 'tick', 'serve': 'answer'}, ('begins tick',) * 2),
    Bug(
        'b1_nested_spin_in_own_group',
        {'watch': 'on_joy', 'serve': 'shut_down_motors', 'publish': ('joy', 'off', 0.1)},
        ('ends on_joy',),
    ),
    *(
        Bug(
            f'b1_future_awaited_{where}',
            {'watch': 'on_switch', 'serve': 'shut_down_motors', 'publish': ('switch', 'off', 0.1)},
            ('ends on_switch',),
        )
        for where in ('in_helper', 'on_many_threads')
    ),
    Bug(
        'b12_pool_exhausted',
        {'watch': 'fourth', 'serve': 'plan'},
        ('asks', 'ends (first|second|third|fourth)'),
    ),
    Bug(
        'b5_future_in_default_group',
        {'watch': 'on_pull', 'serve': 'get', 'call': 'pull'},
        ('ends on_pull',),
    ),
    Bug(
        'b6_timeout_never_runs',
        {'watch': 'on_upload', 'call': 'upload'},
        ('ends on_upload',),
    ),
    Bug(
        'b16_call_in_parameter_callback',
        {'watch': '_set_parameters_callback', 'serve': 'supply', 'set_level': 'lamp'},
        ('ends _set_parameters_callback',),
    ),
    Bug(
        'b17_call_in_transition',
        {'watch': '__on_change_state', 'serve': 'supply', 'configure': 'lamp'},
        ('ends __on_change_state', 'begins report'),
    ),
    Bug('c1_timer_starves_timer', {'watch': 'read_camera'}, ('begins report',) * 3),
    Bug(
        'd1_await_in_own_group',
        {'watch': 'on_open', 'serve': 'lock', 'call': 'open'},
        ('ends on_open',),
    ),
    Bug(
        'f1_rate_on_one_thread',
        {'watch': 'on_go', 'publish': ('go', '', 0.1)},
        ('.*drives',) * 3,
    ),
    Bug(
        'g2_lost_update',
        {'watch': 'on_part', 'publish': ('part', '', 0.0005)},
        ('begins on_part',) * PARTS,
        loses_parts,
        FAST_REPORTS,
    ),
    Bug(
        'g4_lock_taken_twice',
        {'watch': 'on_switch', 'call': 'switch'},
        ('ends on_switch',),
    ),
    Bug(
        'g4_lock_over_a_nested_spin',
        {'watch': 'replan', 'serve': 'plan', 'publish': ('goal', '', 0.0005)},
        ('begins replan',) * ROUNDS,
    ),
    Bug(
        'g4_lock_over_a_call',
        {'watch': 'plan_ahead', 'serve': 'plan'},
        ('ends plan_ahead',) * ROUNDS,
    ),
    Bug(
        'h1_cancel_not_seen',
        {'watch': '', 'cancel': 'move'},
        ('cancel answered',),
    ),
    Bug(
        'h2_execute_outside_its_group',
        {'watch': 'drift', 'cancel': 'move'},
        ('execute ends',),
        overlaps_execute,
        SLOW_EXECUTE,
    ),
]


def symptoms(run_forked: RunForked, seconds: float) -> dict[str, bool]:
    """Whether the symptom shows, for each program and its mended twin."""
    stems = {stem: bug for bug in REPRODUCED for stem in (bug.name, f'{bug.name}_mended')}
    told = run_forked(bug.program(stem, seconds) for stem, bug in stems.items())
    return {stem: _judge(bug, stem, told[stem]) for stem, bug in stems.items()}


def _judge(bug: Bug, stem: str, lines: Lines) -> bool:
    assert 'asks' in lines, f'{stem} has not begun:\n' + '\n'.join(lines)
    return bug.has_symptom(lines)


def expected() -> dict[str, bool]:
    return {
        stem: stem == bug.name for bug in REPRODUCED for stem in (bug.name, f'{bug.name}_mended')
    }


def test_reproduced_bugs_show_and_their_twins_do_not(run_forked: RunForked) -> None:
    assert symptoms(run_forked, SHORT_S) == expected()


@pytest.mark.slow
def test_reproduced_bugs_stay_and_their_twins_stay_well(run_forked: RunForked) -> None:
    assert symptoms(run_forked, LONG_S) == expected()
