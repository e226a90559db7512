"""What was checked: of each unit its executor, and what is proven, broken and undecided of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.text import Text

from ros2cc_extract.findings.promises import Judgement, Mark, Promise
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.text.style import table
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Executor, Spec
from ros2cc_extract.text_escaping import one_line, printable

MOST_BLOCKS = 3
"""More units than this are a row each."""
MOST_ROWS = 28
MOST_REASONS = 3
LONGEST_EXECUTOR = 10
_SIGNS = {Mark.KEPT: '✓', Mark.BROKEN: '✗', Mark.OPEN: '?'}
_PLAIN_SIGNS = {Mark.KEPT: 'ok', Mark.BROKEN: 'NO', Mark.OPEN: '?'}
"""Of a terminal that knows ASCII only."""
_COLOURS = {Mark.KEPT: 'green', Mark.BROKEN: 'red', Mark.OPEN: 'yellow'}
_SHORT = {'SingleThreadedExecutor': 'single', 'MultiThreadedExecutor': 'multi'}
_COLUMNS = {
    Promise.DEADLOCK: 'deadlock',
    Promise.WAITS: 'waits',
    Promise.STARVATION: 'starve',
    Promise.RACES: 'races',
    Promise.SETTINGS: 'settings',
}


@dataclass(frozen=True)
class Row:
    """A unit with its promises."""

    unit: Spec
    promises: Sequence[Judgement]

    @property
    def weight(self) -> tuple[int, int]:
        """Sorts the worst first."""
        marks = Counter(each.mark for each in self.promises)
        return -marks[Mark.BROKEN], -marks[Mark.OPEN]


def print_units(
    units: Sequence[Spec],
    promises: Sequence[Sequence[Judgement]],
    console: Console,
    *,
    all_rows: bool = False,
) -> None:
    """
    Print the units, the worst first.

    :param all_rows: each in full, however many there are.
    """
    rows = [Row(printable(unit), printable(of)) for unit, of in zip(units, promises, strict=True)]
    rows.sort(key=lambda row: row.weight)
    if len(rows) <= MOST_BLOCKS or all_rows:
        for row in rows:
            _print_block(row, console)
    else:
        _print_rows(rows, console)


def _print_block(row: Row, console: Console) -> None:
    nodes = ', '.join(row.unit.nodes) or row.unit.name
    told = f'{_executor(row.unit.executor)}, {counted(len(row.unit.callbacks), "callbacks")}'
    console.print(Text.assemble('checked ', (nodes, 'bold'), f': {told}'), soft_wrap=True)
    signs = _signs(console)
    line = Text('  ')
    for each in row.promises:
        words = Text(f'{signs[each.mark]} {each.promise.value}', _COLOURS[each.mark])
        if line.cell_len > 2 and line.cell_len + words.cell_len + 2 > console.width:
            console.print(line, soft_wrap=True)
            line = Text('  ')
        line = Text.assemble(line, '  ' if line.cell_len > 2 else '', words)
    console.print(line, soft_wrap=True)
    for reason, claims in _reasons([row]).items():
        console.print(f'  ? {", ".join(dict.fromkeys(claims))}: {reason}', soft_wrap=True)


def _reasons(rows: Sequence[Row]) -> dict[str, list[str]]:
    """Give why promises are undecided, with which."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        for each in row.promises:
            if each.mark is Mark.OPEN:
                reasons.setdefault(one_line(each.reason), []).append(each.promise.value)
    return reasons


def _print_rows(rows: Sequence[Row], console: Console) -> None:
    heads = ('checked', 'executor', 'callbacks', *_COLUMNS.values())
    grid = table(*heads, gap=1)
    for column in grid.columns[:2]:
        column.overflow, column.no_wrap = 'ellipsis', True
    for column in grid.columns[1:]:
        column.min_width = min(LONGEST_EXECUTOR, len(str(column.header)))
        column.no_wrap = True
    signs = _signs(console)
    for row in rows[:MOST_ROWS]:
        marks = [Text(signs[each.mark], _COLOURS[each.mark]) for each in row.promises]
        nodes = ', '.join(row.unit.nodes) or row.unit.name
        grid.add_row(
            nodes, _short_executor(row.unit.executor), str(len(row.unit.callbacks)), *marks
        )
    console.print(grid)
    if len(rows) > MOST_ROWS:
        console.print(f'{_left_out(rows[MOST_ROWS:])}; --verbose shows them')
    reasons = sorted(_reasons(rows).items(), key=lambda item: -len(item[1]))
    for reason, claims in reasons[:MOST_REASONS]:
        told = Text(f'? {_times(len(claims))}: {reason}', overflow='ellipsis', no_wrap=True)
        console.print(told)
    if len(reasons) > MOST_REASONS:
        left = counted(len(reasons) - MOST_REASONS, 'more reasons')
        console.print(f'? {left}; --verbose shows them')


def _times(number: int) -> str:
    return 'once' if number == 1 else f'{number} times'


def _left_out(rows: Sequence[Row]) -> str:
    kept = sum(row.weight == (0, 0) for row in rows)
    return f'{counted(len(rows), "more units")}, {kept} with every promise kept'


def _executor(executor: Executor) -> str:
    threads = counted(len(executor.threads), 'threads')
    if isinstance(executor.kind, Unknown):
        return f'no executor found, {threads} assumed'
    assumed = ' assumed, as many as CPUs' if _is_default(executor) else ''
    return f'{executor.kind or "executor"}, {threads}{assumed}'


def _short_executor(executor: Executor) -> str:
    if isinstance(executor.kind, Unknown):
        return 'none found'
    kind = _SHORT.get(executor.kind or '', (executor.kind or 'executor').removesuffix('Executor'))
    doubt = '?' if _is_default(executor) else ''
    return f'{kind[:LONGEST_EXECUTOR]} {len(executor.threads)}{doubt}'


def _is_default(executor: Executor) -> bool:
    return executor.threads_source == 'default_cpu_count'


def _signs(console: Console) -> dict[Mark, str]:
    try:
        ''.join(_SIGNS.values()).encode(console.encoding)
    except UnicodeError:
        return _PLAIN_SIGNS
    return _SIGNS


def unknown_lines(facts: int, assumed: int, paths: str) -> Iterator[str]:
    """Say in one line how much is not known, and where it is listed."""
    parts = [f'{counted(facts, "facts")} unresolved'] if facts else []
    parts += [f'{assumed} assumed'] if assumed else []
    if parts:
        yield f'not known: {", ".join(parts)}; ros2cc-extract spec {paths} lists them'
