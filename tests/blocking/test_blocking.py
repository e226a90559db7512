"""
What can be said of each blocking pattern without running it is what was observed.

The same programs run for real in ``tests/live/test_live_blocking.py``.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import pytest

from ros2cc_extract.checker.api import Limits, Query, Verdict, check, read_model
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.releases.table import RCLPY
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.support.cells import TIMERS, Cell, all_cells, cells_of_rows

CELLS = all_cells()
# Two arrivals of each of four timers that meet at a barrier have more states than 8 GB hold. The
# limit is on states, which are the same on every machine.
COMPACT = Options(profile=Profile.RCLPY, text=Text.COMPACT, limits=Limits(states=400_000))
TIMER_CALLBACKS = dict(zip(TIMERS, ('tock', 'tick'), strict=True))
every_cell = pytest.mark.parametrize('cell', CELLS, ids=lambda cell: cell.name)
#: It has the row of every cell that has one.
HAS_ROWS = '9.1.5'
STEALS_THE_NODE, STUCK_IN_ITS_GROUP = 'CC106', 'CC101'


@cache
def told(cell: Cell) -> tuple[Spec, Verification, tuple[Finding, ...]]:
    """The unit of the program that asks, its verdicts, and what is found in it."""
    extraction = scan_text(cell.text, cell.path.name)
    unit = replace(extraction.units[0], rclpy=HAS_ROWS if cell.row else None)
    verification = verify_unit(close(unit), COMPACT)
    return unit, verification, findings_of([unit], extraction.diagnostics, [verification])


def verdict_on_askers(family: str, cell: Cell) -> Verdict | None:
    """What the model says of the callbacks that ask; the worst, where there are several."""
    _, verification, _ = told(cell)
    verdicts = {
        result.verdict
        for result in verification.results
        if result.family == family and result.callbacks[0].startswith('ask')
    }
    worst_first = (Verdict.NOT_SATISFIED, Verdict.UNDECIDED, Verdict.SATISFIED)
    return next((verdict for verdict in worst_first if verdict in verdicts), None)


def end_of(cell: Cell) -> str:
    """How the callbacks that ask end, by the verdicts of the model, in the words of the cell."""
    ends = verdict_on_askers('progress', cell)
    if ends is Verdict.NOT_SATISFIED:
        return 'asleep' if can_be(sleeping(cell), cell) else 'blocks'
    if verdict_on_askers('answered_spin', cell) is Verdict.NOT_SATISFIED:
        return 'no answer'
    return 'undecided' if ends is Verdict.UNDECIDED else 'ok'


def can_be(formula: str, cell: Cell) -> bool:
    """Whether the whole text of the cell's model has a state like that."""
    if not formula:
        return False
    unit, _, _ = told(cell)
    rendered = render(close(unit), profile=Profile.RCLPY)
    result = check(read_model(rendered.xml, 'cell.xml'), [Query(f'E<> ({formula})', None, None)])
    return result.answers[0].verdict is Verdict.SATISFIED


def sleeping(cell: Cell) -> str:
    """Nothing moves, although what a coroutine awaits is there."""
    unit, _, _ = told(cell)
    places = (
        place
        for place, callback in enumerate(unit.callbacks)
        if any(block.foreign for block in callback.blocking)
    )
    return ' or '.join(f'deadlock and cb_foreign_done[{place}][0]' for place in places)


def test_the_table_has_all_its_cells() -> None:
    assert len(CELLS) == 47
    assert {cell.executor for cell in CELLS} == {'single', 'multi'}


@every_cell
def test_the_callback_ends_as_observed(cell: Cell) -> None:
    assert end_of(cell) == cell.facts[0]


@pytest.mark.parametrize('cell', cells_of_rows(), ids=lambda cell: f'{cell.name}_{cell.row}')
def test_the_callback_ends_as_observed_on_releases_with_the_row(cell: Cell) -> None:
    assert {row.name: row for row in RCLPY}[cell.row].holds(HAS_ROWS)
    _, _, findings = told(cell)
    raised = [finding for finding in findings if 'raises RuntimeError' in finding.message]
    assert ('raises' if raised else end_of(cell)) == cell.facts[0]


@every_cell
def test_a_dead_lock_is_where_a_callback_hangs_or_its_node_is_lost(cell: Cell) -> None:
    _, verification, _ = told(cell)
    hangs = cell.facts[0] in ('blocks', 'asleep')
    expected = hangs or 'node lost' in cell.facts
    assert verification.results[0].family == 'deadlock'
    assert (verification.results[0].verdict is Verdict.NOT_SATISFIED) == expected


@every_cell
def test_nothing_of_a_cell_is_left_out_of_its_model(cell: Cell) -> None:
    _, verification, _ = told(cell)
    reasons = [result.reason or '' for result in verification.results]
    left_out = [reason for reason in reasons if 'leaves out' in reason]
    # A barrier makes four callbacks ask at once, whose end only they report.
    assert [reason for reason in left_out if 'Barrier.wait' not in reason] == []


@every_cell
def test_the_node_is_lost_in_the_model_as_observed(cell: Cell) -> None:
    is_lost = verdict_on_askers('node_kept', cell) is Verdict.NOT_SATISFIED
    assert is_lost == ('node lost' in cell.facts)


@every_cell
def test_a_lost_node_is_found_and_no_other(cell: Cell) -> None:
    _, _, findings = told(cell)
    found = [finding for finding in findings if finding.code == STEALS_THE_NODE]
    assert bool(found) == ('node lost' in cell.facts)
    assert all(finding.run is not None and finding.run.moments for finding in found)


@pytest.mark.parametrize(
    'cell', [c for c in CELLS if c.facts[0] == 'no answer'], ids=lambda cell: cell.name
)
def test_a_nested_spin_without_an_answer_is_found(cell: Cell) -> None:
    _, _, findings = told(cell)
    assert STUCK_IN_ITS_GROUP in {finding.code for finding in findings}


MEANWHILE = [
    (cell, timer)
    for cell in CELLS
    for timer in TIMERS
    if any(fact.startswith('meanwhile') for fact in cell.facts)
    and f'def {TIMER_CALLBACKS[timer]}(' in cell.text
]


@pytest.mark.parametrize(
    ('cell', 'timer'), MEANWHILE, ids=[f'{cell.name}-{timer}' for cell, timer in MEANWHILE]
)
def test_timers_run_meanwhile_as_observed(cell: Cell, timer: str) -> None:
    unit, _, _ = told(cell)
    places = {callback.name: place for place, callback in enumerate(unit.callbacks)}
    asks, ticks = places['ask'], places[TIMER_CALLBACKS[timer]]
    observed = any(fact.startswith('meanwhile') and timer in fact for fact in cell.facts)
    assert can_be(f'cb_unfinished({asks}) and cb_running({ticks})', cell) == observed


SPUN = [
    (cell, timer)
    for cell in CELLS
    for timer in TIMERS
    if cell.facts[1:] and 'spin' in cell.name and f'def {TIMER_CALLBACKS[timer]}(' in cell.text
]


@pytest.mark.parametrize(('cell', 'timer'), SPUN, ids=[f'{c.name}-{timer}' for c, timer in SPUN])
def test_timers_run_inside_a_nested_spin(cell: Cell, timer: str) -> None:
    unit, _, _ = told(cell)
    places = {callback.name: place for place, callback in enumerate(unit.callbacks)}
    asks, ticks = places['ask'], places[TIMER_CALLBACKS[timer]]
    assert can_be(f'cb_unfinished({asks}) and cb_running({ticks})', cell)
