"""What stands below the table of a sweep: the number of threads first, then the rows that turn."""

from __future__ import annotations

import io
import re
from pathlib import Path

import pytest

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.jobs.pools import Processes
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.report.text.sweep import print_sweep
from ros2cc_extract.spec.close import Policy
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.sweep import points, run_sweep

EXAMPLES = Path(__file__).parents[3] / 'launch_free_examples'
RCLPY = Options(profile=Profile.RCLPY, structural=False)


TWO = ('1 thread', '2 threads')
Cycles = tuple[int | None, ...]


@pytest.fixture(autouse=True)
def width_of_a_log(monkeypatch: pytest.MonkeyPatch) -> None:
    """The tests may run in a narrow window."""
    monkeypatch.delenv('COLUMNS', raising=False)


def printed(example: str, threads: range, cycles: Cycles, options: Options) -> str:
    (unit,) = scan([EXAMPLES / example / 'node.py']).units
    swept = run_sweep(unit, Policy(), options, points(threads, cycles), Processes(1))
    out = io.StringIO()
    print_sweep(swept, console_for(out))
    return out.getvalue()


def below_the_table(example: str, threads: range, cycles: Cycles, options: Options) -> str:
    text = printed(example, threads, cycles, options)
    below = text.partition('  seconds ')[2].partition('\n')[2]
    return ''.join(line for line in below.splitlines(keepends=True) if 'from slices' not in line)


@pytest.mark.parametrize(
    ('cycles', 'heads'),
    [
        ((1,), ['#', 'query', *TWO]),
        (
            (1, None),
            ['#', 'query', *(f'{n}, cycle {c}' for c in (1, 'inf') for n in TWO)],
        ),
    ],
)
def test_a_column_is_headed_by_its_threads_and_where_they_differ_by_its_bound(
    cycles: Cycles, heads: list[str]
) -> None:
    text = printed('paper_case1', range(1, 3), cycles, Options(profile=Profile.PAPER))
    assert re.split(r'\s{2,}', text.splitlines()[1].strip()) == heads


def test_the_smallest_number_of_threads_leads_and_rows_that_turn_are_grouped() -> None:
    said = below_the_table('pool_exhaustion', range(1, 5), (1,), RCLPY)
    assert said == (
        '  smallest number of threads without a deadlock: 3\n'
        '  from 2 threads on:\n'
        '    not satisfied -> satisfied: executable 5-6; can overlap 22-23, 26-27, 30; '
        'starvation 38-39\n'
        '    satisfied -> not satisfied: never together 7-8, 11-12, 15; '
        'group always open 33-34; starvation 40-41; serial 50\n'
        '  from 3 threads on:\n'
        '    not satisfied -> satisfied: deadlock 1; can overlap 24-25, 28-29; '
        'starvation 37, 40-41; progress 47-48; pool exhaustion 49\n'
        '    satisfied -> not satisfied: never together 9-10, 13-14\n'
        '  from 4 threads on:\n'
        '    satisfied -> not satisfied: never together 16\n'
        '    not satisfied -> satisfied: can overlap 31\n'
    )


def test_where_no_number_of_threads_helps_that_is_said() -> None:
    said = below_the_table('service_deadlock', range(2, 4), (1,), RCLPY)
    assert said == '  none of these numbers of threads is shown to be free of a deadlock\n'


def test_nothing_is_concluded_where_nobody_waits() -> None:
    assert below_the_table('two_groups', range(2, 4), (1,), RCLPY) == ''


def test_each_bound_of_arrivals_has_its_own_turns() -> None:
    options = Options(profile=Profile.PAPER)
    said = below_the_table('paper_case2', range(1, 4), (1, 2), options)
    assert said.splitlines()[1:] == [
        '  from 2 threads on (max-cycle 1):',
        '    satisfied -> not satisfied: starvation 25-26',
        '  from 2 threads on (max-cycle 2):',
        '    satisfied -> not satisfied: starvation 25-26',
    ]
