"""
The table of behaviours is what was observed, and a reversed row is caught.

Observations and traces lie here, so that no release is needed for that; on the wheels that are
there, and on the release of the day, all is observed anew.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from unittest import mock

import pytest

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import read_traces
from ros2cc_extract.conform.unit import compare, pair_units
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import ROWS
from tests.conformance.suite import run_suite
from tests.releases.observe import HERE, WHEELS, observe, program_of, read_observed
from tests.releases.turns import release_of_the_day

OBSERVED = read_observed()
#: Which rows no single run shows, and why.
UNOBSERVED = {
    'pool-order-varies': 'of Python, and only now and then',
    'no-global-lock': 'of a build of Python that has no global lock',
}
#: No release that is supported lacks it, and of others only the executor core runs here.
NEVER_LACKED = {'node-stays'}
#: Of rows that a model reads. The model of one that yields to a thread is woken by whatever is
#: served next, and that of a node that goes away leaves the spin out: no trace contradicts those.
TRACES = sorted((HERE / 'traces').glob('*.jsonl'))
PROGRAMS = 12

each_observed = pytest.mark.parametrize(
    'row', [row for row in ROWS if row.name in OBSERVED], ids=lambda row: row.name
)


def contradictions(row: Behaviour, holds: Callable[[str], bool | None]) -> list[str]:
    """Releases that were seen to do otherwise."""
    return [release for release, seen in OBSERVED[row.name].items() if holds(release) is not seen]


@each_observed
def test_the_table_is_what_was_observed(row: Behaviour) -> None:
    assert contradictions(row, row.holds) == []


@each_observed
def test_a_turned_row_is_caught(row: Behaviour) -> None:
    assert contradictions(row, lambda release: not row.holds(release)) == [*OBSERVED[row.name]]
    differs = set(OBSERVED[row.name].values()) == {True, False}
    assert differs == (row.name not in NEVER_LACKED)


def test_every_row_is_observed_or_says_why_not() -> None:
    assert {row.name for row in ROWS} - OBSERVED.keys() == UNOBSERVED.keys()
    assert {row.name for row in ROWS if program_of(row).exists()} == OBSERVED.keys()


def outcomes(trace_file: Path, row: Behaviour) -> set[Outcome]:
    program = program_of(row)
    traces = read_traces(trace_file)
    units = scan_text(program.read_text(), program.name).units
    pairs = pair_units(traces, units)
    return {compare(trace, executor, spec).answer.outcome for trace, executor, spec in pairs}


@pytest.mark.parametrize('trace_file', TRACES, ids=lambda path: path.stem)
def test_a_trace_contradicts_the_model_of_the_turned_row(trace_file: Path) -> None:
    name = trace_file.name.rpartition('_')[0]
    row = next(row for row in ROWS if program_of(row).stem == name)
    holds = Behaviour.holds

    def turned(asked: Behaviour, version: str | None) -> bool | None:
        told = holds(asked, version)
        return not told if asked is row and told is not None else told

    assert outcomes(trace_file, row) == {Outcome.CONFORMS}
    with mock.patch.object(Behaviour, 'holds', turned):
        assert outcomes(trace_file, row) == {Outcome.DIVERGES}


def as_told(version: str) -> dict[str, bool | None]:
    return {row.name: row.holds(version) for row in ROWS if row.name in OBSERVED}


@pytest.mark.live
@pytest.mark.parametrize('version', WHEELS)
def test_a_wheel_does_what_the_table_says(version: str) -> None:
    if not Path(WHEELS[version]).exists():
        pytest.skip(f'no rclpy {version} in {WHEELS[version]}')
    seen = dict(observe(WHEELS[version], None))
    assert seen == {name: as_told(version)[name] for name in seen}


@pytest.mark.live
def test_the_release_of_the_day_does_what_the_table_says() -> None:
    python, release = release_of_the_day()
    seen = dict(observe(python, release))
    assert seen == {name: as_told(release.version)[name] for name in seen}
    tally = run_suite(python, 700_100, PROGRAMS, None, release)
    assert set(tally.outcomes) == {Outcome.CONFORMS}
