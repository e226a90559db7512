"""
The cells of the table of blocking patterns: a program of ``tests/blocking`` on an executor.

The last lines of a program say what was observed on rclpy 7.1.6 and 9.1.2, for each executor:
how the callback that asks comes to its end (``ok``, ``blocks``, ``asleep`` until something wakes
the executor, ``no answer``), and where the program shows it, whose timers run meanwhile and
whether the node is still served afterwards.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

PROGRAMS = Path(__file__).parents[1] / 'blocking'
HELPERS = ('answering',)
MULTI = 'executors.MultiThreadedExecutor(num_threads=4)'
SINGLE = 'executors.SingleThreadedExecutor()'
TIMERS = ('own group', 'other group')
# A lost node has one run more if its timer was ready in the lap of the callback that lost it.
KEPT_RUNS = 3


@dataclass(frozen=True)
class Cell:
    """
    One program on one executor.

    :param facts: what was observed; the first is how the callback that asks ends.
    :param text: of the program, with that executor.
    """

    path: Path
    executor: str
    facts: tuple[str, ...]
    text: str

    @property
    def name(self) -> str:
        return f'{self.path.stem}_{self.executor}'


def all_cells() -> list[Cell]:
    """Read every cell of the table, in the order of the programs' names."""
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
        executor, _, facts = line.removeprefix('# ').partition(': ')
        if line.startswith('# ') and executor in ('single', 'multi'):
            own = text if executor == 'multi' else text.replace(MULTI, SINGLE)
            found.append(Cell(path, executor, tuple(facts.split(', ')), own))
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
        return 'blocks'
    if 'is woken' in meanwhile:
        return 'asleep'
    return 'no answer' if 'no answer' in meanwhile else 'ok'


def _timers_in(lines: Sequence[str]) -> list[str]:
    return [timer for timer in TIMERS if timer in lines]
