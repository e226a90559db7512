"""
What rates show is what rclpy counts: the load table, and paper case 2 at several rates.

Runs are counted, and compared with the share that ``load_of`` foretells.
"""

from __future__ import annotations

import subprocess
from collections.abc import Sequence
from pathlib import Path

import pytest
from side_by_side import Program, RunForked

from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.results.load import Load, LoadKind, load_of

HERE = Path(__file__).parent
Member = tuple[str, str, float, float]
Members = Sequence[Member]


def two_timers(total: float, period_s: float) -> Members:
    """The load table: each works for half of the load of its period."""
    work_s = total * period_s / 2
    return [('timer', name, period_s, work_s) for name in ('first', 'second')]


def paper_case_2(c_every: float, unit_s: float, *, turned: bool = False) -> Members:
    """Two timers that do nothing; SUB1 works one unit, SUB2 two, msg_D comes every two units."""
    subs = [
        ('subscription', 'msg_C', c_every * unit_s, unit_s),
        ('subscription', 'msg_D', 2 * unit_s, 2 * unit_s),
    ]
    timers = [('timer', name, unit_s, 0.0) for name in ('A', 'B')]
    return [*timers, *(subs[::-1] if turned else subs)]


LOADS = (0.5, 0.9, 1.0, 1.2, 1.9, 2.1)
EVERY = (1.0, 1.25, 1.5, 2.0, 3.0)


def programs(period_s: float, unit_s: float) -> dict[str, Members]:
    return {
        **{f'load_{total}'.replace('.', '_'): two_timers(total, period_s) for total in LOADS},
        **{f'every_{c}'.replace('.', '_'): paper_case_2(c, unit_s) for c in EVERY},
        'turned': paper_case_2(1.0, unit_s, turned=True),
    }


def spec_of(members: Members) -> Spec:
    kinds = {'timer': EntityKind.TIMER, 'subscription': EntityKind.SUBSCRIPTION}
    return Spec(
        name='rated',
        callbacks=tuple(
            Callback(
                name=name,
                type=kinds[kind].published_type,
                entity=kinds[kind],
                group='group',
                period_s=period_s,
                duration_s=work_s,
            )
            for kind, name, period_s, work_s in members
        ),
        groups=(CallbackGroup(name='group', type=GroupType.EXCLUSIVE),),
        executor=Executor(
            name='executor',
            kind='MultiThreadedExecutor',
            threads=tuple(f'thread_{number}' for number in range(4)),
        ),
    )


def foretold(members: Members) -> Load:
    """Of the member served last."""
    spec = spec_of(members)
    return load_of(spec, spec.callbacks[-1])


def counted(run_forked: RunForked, chosen: dict[str, Members], seconds: float) -> dict[str, float]:
    """Share of its arrivals that the last member of each program served."""
    texts = {
        name: f'import rates\nrates.run({list(members)!r})\n' for name, members in chosen.items()
    }
    told = run_forked(
        Program(name=name, path=str(HERE / f'{name}.py'), text=text, patience_s=seconds)
        for name, text in texts.items()
    )
    return {
        name: told[name].count(members[-1][1]) / (seconds / members[-1][2])
        for name, members in chosen.items()
    }


def begins_in_order(python: str) -> bool:
    """Return whether threads of a pool begin in the order in which they were given their work."""
    asked = [python, '-c', 'import sys; sys.exit(sys.version_info >= (3, 13))']
    return subprocess.run(asked, check=False).returncode == 0


def test_load_decides_what_the_last_member_gets(run_forked: RunForked, rclpy_python: str) -> None:
    """A busy machine takes from what is left, and never adds to it; Python 3.13 may."""
    ordered = begins_in_order(rclpy_python)
    short = ('load_0_9', 'load_1_2', 'load_2_1', 'every_1_0', 'every_1_5', 'every_2_0', 'turned')
    chosen = {name: programs(0.2, 0.2)[name] for name in short}
    for name, share in counted(run_forked, chosen, 6.0).items():
        most = foretold(chosen[name]).runs
        assert most is not None
        assert most / 2 - 0.05 <= share, (name, share, most)
        assert share <= most + 0.1 or not ordered, (name, share, most)


@pytest.mark.slow
def test_load_table_and_paper_case_2_as_published(
    run_forked: RunForked, rclpy_python: str
) -> None:
    """At the pace of the table: 0.2 s for 8 s; a unit of 0.2 s for 40 units."""
    if not begins_in_order(rclpy_python):
        pytest.skip('the table is of Python 3.11 and 3.12')
    chosen = programs(0.2, 0.2)
    shares = counted(run_forked, chosen, 8.0)
    expected = {name: foretold(members).runs for name, members in chosen.items()}
    assert shares == {name: pytest.approx(share, abs=0.06) for name, share in expected.items()}


def test_words_of_the_table() -> None:
    chosen = programs(0.2, 1.0)
    assert {name: foretold(members).kind for name, members in chosen.items()} == {
        'load_0_5': LoadKind.FINE,
        'load_0_9': LoadKind.FINE,
        'load_1_0': LoadKind.FINE,
        'load_1_2': LoadKind.DEGRADED,
        'load_1_9': LoadKind.DEGRADED,
        'load_2_1': LoadKind.STARVED,
        'every_1_0': LoadKind.STARVED,
        'every_1_25': LoadKind.DEGRADED,
        'every_1_5': LoadKind.DEGRADED,
        'every_2_0': LoadKind.FINE,
        'every_3_0': LoadKind.FINE,
        'turned': LoadKind.STARVED,
    }
