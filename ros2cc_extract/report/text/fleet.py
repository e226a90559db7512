"""The table of a fleet: a row for each repository, and one line for all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rich.console import Console

from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.text.style import print_rows
from ros2cc_extract.text_escaping import one_line

COLUMNS = ('files', 'units', 'errors', 'warnings', 'notes', 'undecided')
Row = tuple[str, Mapping[str, int], str]
"""Name, counts and what has come of it."""


def print_fleet(rows: Sequence[Row], errors: Sequence[str], line: str, console: Console) -> None:
    """Print all rows in their order, what went wrong, and the line."""
    cells: list[tuple[str, ...]] = [('repository', *COLUMNS, 'result')]
    for name, counts, words in rows:
        numbers = (str(counts[column]) if column in counts else '-' for column in COLUMNS)
        cells.append((one_line(name), *numbers, one_line(words)))
    print_rows(cells, console)
    for error in errors:
        console.print(one_line(error), soft_wrap=True)
    console.print(line, style='bold', soft_wrap=True)


def fleet_line(done: int, total: int, found: Mapping[str, int]) -> str:
    """Say how many were checked, and what was found in them."""
    kinds = [counted(found[kind], kind) for kind in COLUMNS[2:5] if found.get(kind)]
    verdicts = counted(found['undecided'], 'verdicts') if found.get('undecided') else ''
    words = ', '.join(kinds) or 'no problems'
    more = f'; {verdicts} undecided' if verdicts else ''
    return f'Found {words} in {done} of {total} repositories{more}'
