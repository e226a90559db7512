"""A unit of hundreds of callbacks has claims by the ten thousand: its limit on time holds."""

from __future__ import annotations

import io
import time
from pathlib import Path

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.report.text.style import console_for
from ros2cc_extract.report.text.verdicts import MOST_ROWS, ROWS_OF_A_KIND, print_table
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.yaml.yaml_io import load_specs
from ros2cc_extract.verify.results.results import (
    MOST_RUNS,
    QueryResult,
    Verification,
    with_fewer_runs,
)
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

MANY = 300
AT_ONCE = Limits(seconds=0.2)


def of_size(size: int, folder: Path) -> ClosedSpec:
    callbacks = ''.join(
        f'    - {{name: c{n}, type: TMR, callback_group: g}}\n' for n in range(size)
    )
    path = folder / 'large.yaml'
    path.write_text(
        f'node:\n  name: n\n  callbacks:\n{callbacks}'
        '  callback_groups:\n    - {name: g, type: REENTRANT}\n'
        '  executor: {name: e, threads: [{name: t1}, {name: t2}]}\n'
    )
    (spec,) = load_specs(path)
    return close(spec)


def test_the_whole_unit_is_not_read_for_ever(tmp_path: Path) -> None:
    closed = of_size(MANY, tmp_path)
    started = time.process_time()
    verified = verify_unit(closed, Options(limits=AT_ONCE))
    assert time.process_time() - started < 6
    assert len(verified.results) > MANY * MANY
    assert {(r.verdict, r.reason) for r in verified.results} == {
        (Verdict.UNDECIDED, 'the limit of 0.2 s was reached')
    }


def test_where_the_time_is_over_nothing_more_begins(tmp_path: Path) -> None:
    closed = of_size(40, tmp_path)
    options = Options(profile=Profile.RCLPY, limits=Limits(seconds=1e-6))
    assert {r.verdict for r in verify_unit(closed, options).results} == {Verdict.UNDECIDED}


def result(number: int, verdict: Verdict = Verdict.NOT_SATISFIED) -> QueryResult:
    return QueryResult(
        family='never_together',
        formula=f'A[] f({number})',
        words=f'claim {number}',
        callbacks=(),
        verdict=verdict,
        reason=None,
        seconds=0.0,
        run=lambda: None,  # type: ignore[arg-type, return-value]
    )


def verification(*results: QueryResult) -> Verification:
    return Verification(
        model='m',
        profile=None,
        text=None,
        engine='native',
        states=1,
        transitions=0,
        seconds=0.0,
        peak_mb=0.0,
        complete=True,
        results=results,
    )


def test_of_very_many_runs_the_first_of_each_kind_are_kept_and_the_rest_counted() -> None:
    refuted = [result(n) for n in range(MOST_RUNS + 7)]
    held = [result(n, Verdict.SATISFIED) for n in range(MOST_RUNS)]
    fewer = with_fewer_runs(verification(*refuted, *held))
    kept = [n for n, each in enumerate(fewer.results) if each.run is not None]
    assert kept == [*range(MOST_RUNS), *range(MOST_RUNS + 7, 2 * MOST_RUNS + 7)]
    assert [each.verdict for each in fewer.results] == [r.verdict for r in (*refuted, *held)]
    (note,) = fewer.notes
    assert note.startswith('the runs behind 7 verdicts are left out')
    assert with_fewer_runs(fewer) == fewer


def test_a_table_of_very_many_rows_shows_the_first_and_counts_the_rest() -> None:
    few, many = ([result(n) for n in range(size)] for size in (MOST_ROWS, MOST_ROWS + 1))
    rows, folded = printed(few), printed(many)
    assert f'{MOST_ROWS:3}  claim {MOST_ROWS - 1} ' in rows
    assert 'more' not in rows
    assert f'{ROWS_OF_A_KIND:3}  claim {ROWS_OF_A_KIND - 1} ' in ' '.join(folded.split(' '))
    assert f'claim {ROWS_OF_A_KIND} ' not in folded
    left_out = MOST_ROWS + 1 - ROWS_OF_A_KIND
    assert f'  and {left_out} more, never together: not satisfied\n' in folded


def printed(results: list[QueryResult]) -> str:
    out = io.StringIO()
    print_table(verification(*results), console_for(out), details=False)
    return out.getvalue()
