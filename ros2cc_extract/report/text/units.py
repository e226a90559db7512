"""What was checked: of each unit its executor, and what is proven, broken and undecided of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import Console
from rich.text import Text

from ros2cc_extract.findings.promises import Judgement, Mark, Promise
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.unit_rows import (
    COLUMNS,
    LONGEST_EXECUTOR,
    SIGNS,
    Row,
    executor_words,
    short_executor,
    worst_first,
)
from ros2cc_extract.report.text.style import table
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.text_escaping import one_line

MOST_BLOCKS = 3
"""More units than this are a row each."""
MOST_ROWS = 28
MOST_REASONS = 3
_PLAIN_SIGNS = {Mark.KEPT: 'ok', Mark.BROKEN: 'NO', Mark.OPEN: '?'}
"""Of a terminal that knows ASCII only."""
_COLOURS = {Mark.KEPT: 'green', Mark.BROKEN: 'red', Mark.OPEN: 'yellow'}


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
    rows = worst_first(units, promises)
    if len(rows) <= MOST_BLOCKS or all_rows:
        for row in rows:
            _print_block(row, console)
    else:
        _print_rows(rows, console)


def _print_block(row: Row, console: Console) -> None:
    text = f'{executor_words(row.unit.executor)}, {counted(len(row.unit.callbacks), "callbacks")}'
    console.print(Text.assemble('checked ', (row.nodes, 'bold'), f': {text}'), soft_wrap=True)
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
    for each in row.promises:
        if each.mark is Mark.KEPT and each.reason:
            text = f'  {signs[each.mark]} {each.promise.value}, {one_line(each.reason)}'
            console.print(text, soft_wrap=True)


def _reasons(rows: Sequence[Row]) -> dict[str, list[str]]:
    """Give why promises are undecided, with which."""
    reasons: dict[str, list[str]] = {}
    for row in rows:
        for each in row.promises:
            if each.mark is Mark.OPEN:
                reasons.setdefault(one_line(each.reason), []).append(each.promise.value)
    return reasons


def _print_rows(rows: Sequence[Row], console: Console) -> None:
    heads = ('checked', 'executor', 'callbacks', *COLUMNS.values())
    grid = table(*heads, gap=1)
    for column in grid.columns[:2]:
        column.overflow, column.no_wrap = 'ellipsis', True
    for column in grid.columns[1:]:
        column.min_width = min(LONGEST_EXECUTOR, len(str(column.header)))
        column.no_wrap = True
    signs = _signs(console)
    for row in rows[:MOST_ROWS]:
        marks = [Text(signs[each.mark], _COLOURS[each.mark]) for each in row.promises]
        callbacks = str(len(row.unit.callbacks))
        grid.add_row(row.nodes, short_executor(row.unit.executor), callbacks, *marks)
    console.print(grid)
    if len(rows) > MOST_ROWS:
        console.print(f'{_left_out(rows[MOST_ROWS:])}; --verbose shows them')
    reasons = sorted(_reasons(rows).items(), key=lambda item: -len(item[1]))
    for reason, claims in reasons[:MOST_REASONS]:
        text = Text(f'? {_times(len(claims))}: {reason}', overflow='ellipsis', no_wrap=True)
        console.print(text)
    if len(reasons) > MOST_REASONS:
        left = counted(len(reasons) - MOST_REASONS, 'more reasons')
        console.print(f'? {left}; --verbose shows them')
    assumed = [each for row in rows for each in row.promises if each.mark is Mark.KEPT]
    number = sum(bool(each.reason) for each in assumed)
    if number:
        units = counted(number, 'units')
        kept = f'{signs[Mark.KEPT]} {Promise.WAITS.value} in {units} as long as others answer'
        console.print(f'{kept}; --verbose names them')


def _times(number: int) -> str:
    return 'once' if number == 1 else f'{number} times'


def _left_out(rows: Sequence[Row]) -> str:
    kept = sum(row.weight == (0, 0) for row in rows)
    return f'{counted(len(rows), "more units")}, {kept} with every promise kept'


def _signs(console: Console) -> dict[Mark, str]:
    try:
        ''.join(SIGNS.values()).encode(console.encoding)
    except UnicodeError:
        return _PLAIN_SIGNS
    return SIGNS


def unknown_lines(facts: int, assumed: int, paths: str) -> Iterator[str]:
    """Say in one line how much is not known, and where it is listed."""
    parts = [f'{counted(facts, "facts")} unresolved'] if facts else []
    parts += [f'{assumed} assumed'] if assumed else []
    if parts:
        yield f'not known: {", ".join(parts)}; ros2cc-extract spec {paths} lists them'
