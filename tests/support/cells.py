"""
The cells of the table of blocking patterns: a program of ``tests/blocking`` on an executor.

The last lines of a program say what was observed on rclpy 7.1.6 and 9.1.2, for each executor:
how the callback that asks comes to its end (``ok``, ``blocks``, ``asleep`` until something wakes
the executor, ``no answer``), and where the program shows it, whose timers run meanwhile and
whether the node is still served afterwards. Releases that have another row of the table of
behaviours have a line of their own: ``single with future-wakes: ok``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ros2cc_extract.spec.releases.table import RCLPY

PROGRAMS = Path(__file__).parents[1] / 'blocking'
HELPERS = ('answering',)
MULTI = 'executors.MultiThreadedExecutor(num_threads=4)'
SINGLE = 'executors.SingleThreadedExecutor()'
RAISED = 'RuntimeError: '
TIMERS = ('own group', 'other group')
# A lost node has one run more if its timer was ready in the lap of the callback that lost it.
KEPT_RUNS = 3


@dataclass(frozen=True)
class Cell:
    """
    One program on one executor.

    :param facts: what was observed; the first is how the callback that asks ends.
    :param text: of the program, with that executor.
    :param row: of the table of behaviours; releases that have it do so.
    """

    path: Path
    executor: str
    facts: tuple[str, ...]
    text: str
    row: str = ''

    @property
    def name(self) -> str:
        return f'{self.path.stem}_{self.executor}'


def all_cells() -> list[Cell]:
    """Read every cell of the table, in the order of the programs' names."""
    return [cell for cell in _every_line() if not cell.row]


def cells_of_rows() -> list[Cell]:
    """Read what other releases do otherwise."""
    return [cell for cell in _every_line() if cell.row]


def cells_on(release: str) -> list[Cell]:
    """Every cell as a release is to show it."""
    rows = {row.name: row for row in RCLPY}
    other = {cell.name: cell for cell in cells_of_rows() if rows[cell.row].holds(release)}
    return [other.get(cell.name, cell) for cell in all_cells()]


def _every_line() -> list[Cell]:
    paths = sorted(PROGRAMS.glob('*.py'))
    return [
        cell
        for path in paths
        if path.stem not in HELPERS and not path.stem.startswith('test_')
        for cell in _cells(path)
    ]


def _cells(path: Path) -> list[Cell]:
    text = path.read_text(encoding='utf-8')
    found = []
    for line in text.splitlines():
        which, _, facts = line.removeprefix('# ').partition(': ')
        executor, _, row = which.partition(' with ')
        if line.startswith('# ') and executor in ('single', 'multi'):
            own = text if executor == 'multi' else text.replace(MULTI, SINGLE)
            found.append(Cell(path, executor, tuple(facts.split(', ')), own, row))
    return found


def observe(lines: Sequence[str], cell: Cell) -> tuple[str, ...]:
    """Say what the output of a program shows, in the words and the order of the cell's facts."""
    assert 'asks' in lines, f'{cell.name} has not begun:\n' + '\n'.join(lines)
    asked = lines.index('asks')
    went_on = lines.index('goes on') if 'goes on' in lines else len(lines)
    return tuple(_fact(fact, lines[asked:went_on], lines[went_on:]) for fact in cell.facts)


def _fact(fact: str, meanwhile: Sequence[str], afterwards: Sequence[str]) -> str:
    if fact.startswith('meanwhile'):
        return f'meanwhile {" and ".join(_timers_in(meanwhile)) or "nobody"}'
    if fact.startswith('node'):
        runs = sum(line in TIMERS for line in afterwards)
        return 'node kept' if runs >= KEPT_RUNS else 'node lost'
    if not afterwards:
        return 'raises' if any(line.startswith(RAISED) for line in meanwhile) else 'blocks'
    if 'is woken' in meanwhile:
        return 'asleep'
    return 'no answer' if 'no answer' in meanwhile else 'ok'


def _timers_in(lines: Sequence[str]) -> list[str]:
    return [timer for timer in TIMERS if timer in lines]
