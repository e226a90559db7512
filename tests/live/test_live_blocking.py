"""
Every cell of the table of blocking patterns, run on real rclpy of each release under a watchdog.

What must come is waited for, however slow the machine. What must not come counts as blocked after
some seconds: a call that is answered takes milliseconds. The long variant waits longer than the
four seconds of the measured table.
"""

from __future__ import annotations

import pytest
from side_by_side import PATIENCE_S, Built, Program, RunForked

from tests.support.cells import KEPT_RUNS, TIMERS, Cell, all_cells, cells_on, observe

SHORT_S, LONG_S = 1.5, 10.0
# The timers of a node that is still served come every 0.05 s.
AFTERWARDS_S = 0.4
BRIEF, LONG = 'timeout_sec=0.5', f'timeout_sec={PATIENCE_S}'


def program_of(cell: Cell, seconds: float) -> Program:
    """Give the program; an answer that is to come has all the time it needs."""
    answered = cell.facts[0] == 'ok'
    kept = 'node kept' in cell.facts
    return Program(
        name=cell.name,
        path=str(cell.path),
        text=cell.text.replace(BRIEF, LONG) if answered else cell.text,
        patience_s=seconds if cell.facts[0] in ('blocks', 'raises') else PATIENCE_S,
        awaited=('goes on', *(['|'.join(TIMERS)] * KEPT_RUNS if kept else [])),
        afterwards_s=0.0 if kept else AFTERWARDS_S,
    )


def run_cells(
    run_forked: RunForked, seconds: float, release: str = '7.1.6'
) -> dict[str, tuple[str, ...]]:
    cells = {cell.name: cell for cell in cells_on(release)}
    lines = run_forked(program_of(cell, seconds) for cell in cells.values())
    return {name: observe(lines[name], cell) for name, cell in cells.items()}


def expected(release: str = '7.1.6') -> dict[str, tuple[str, ...]]:
    return {cell.name: cell.facts for cell in cells_on(release)}


def test_every_cell_is_as_measured(run_forked: RunForked) -> None:
    assert run_cells(run_forked, SHORT_S) == expected()


def test_every_cell_is_as_the_table_of_releases_has_it(built_today: Built) -> None:
    version, run_forked = built_today
    assert run_cells(run_forked, SHORT_S, version) == expected(version)


@pytest.mark.slow
def test_every_cell_stays_as_measured(run_forked_everywhere: RunForked) -> None:
    assert run_cells(run_forked_everywhere, LONG_S) == expected()


def test_a_program_that_says_nothing_is_an_error() -> None:
    cell = Cell(all_cells()[0].path, 'multi', ('ok',), '')
    with pytest.raises(AssertionError, match='has not begun'):
        observe(['Traceback'], cell)
