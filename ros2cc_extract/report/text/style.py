"""One console for every text report: the same lines on a terminal and in a log."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, TextIO, cast

from rich.cells import cell_len, set_cell_size
from rich.console import Console
from rich.text import Text

from ros2cc_extract.text_escaping import Shown, printable
from ros2cc_extract.verify.results.results import Verdict

if TYPE_CHECKING:
    from rich.table import Table

LOG_WIDTH = 160
GAP = 2
_LINE_END_BLANKS = re.compile(r'[ \t]+(?=\n)')

_COLOURS = {
    Verdict.SATISFIED: 'green',
    Verdict.NOT_SATISFIED: 'red',
    Verdict.UNDECIDED: 'yellow',
}


def console_for(stream: TextIO) -> Console:
    """Make a console; where the stream is no terminal the width does not depend on the machine."""
    width = None if stream.isatty() or 'COLUMNS' in os.environ else LOG_WIDTH
    # The oldest rich that is allowed does not know FORCE_COLOR.
    is_forced = bool(os.environ.get('FORCE_COLOR')) and os.environ.get('TTY_COMPATIBLE') != '0'
    forced = True if is_forced else None
    is_styled = Console(file=stream, force_terminal=forced).is_terminal
    shown = cast(TextIO, Shown(stream, styled=is_styled, in_log=True))
    target = cast(TextIO, Unpadded(shown))
    return _ReportConsole(
        file=target,
        force_terminal=forced,
        width=width,
        highlight=False,
        markup=False,
        emoji=False,
    )


class _ReportConsole(Console):
    """A console where a reader that leaves is an error like any other."""

    def on_broken_pipe(self) -> None:
        """Go on with the error; rich would end the process with the status of findings."""
        raise


class Unpadded:
    """Takes the blanks off line ends with which a table fills its last column."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        self._stream.write(_LINE_END_BLANKS.sub('', text))
        return len(text)

    def flush(self) -> None:
        self._stream.flush()

    def isatty(self) -> bool:
        return self._stream.isatty()

    def fileno(self) -> int:
        return self._stream.fileno()

    @property
    def encoding(self) -> str:
        return self._stream.encoding


def table(*headers: str, gap: int = GAP) -> Table:
    """Make a table without frames, which survives copying into an issue."""
    # Imported late: most first screens hold no table.
    from rich.table import Table

    made = Table(box=None, pad_edge=False, padding=(0, gap, 0, 0), header_style='bold')
    for header in headers:
        made.add_column(header, overflow='fold')
    return made


def print_rows(rows: Sequence[Sequence[str]], console: Console, *, indent: int = 0) -> None:
    """Print rows of plain text below each other as a table without headers does."""
    rows = printable(rows)
    widths = [max(map(cell_len, column)) for column in zip(*rows, strict=True)]
    if indent + sum(widths) + GAP * (len(widths) - 1) <= console.width:
        # Most rows fit, and a table takes a hundred times as long as a line.
        for row in rows:
            cells = (set_cell_size(cell, w) for cell, w in zip(row, widths, strict=True))
            console.out(' ' * indent + (' ' * GAP).join(cells).rstrip(), highlight=False)
        return
    from rich.padding import Padding

    wrapped = table(*[''] * len(widths))
    wrapped.show_header = False
    for row in rows:
        wrapped.add_row(*row)
    console.print(Padding(wrapped, (0, 0, 0, indent)))


def verdict_text(verdict: Verdict, reason: str | None = None) -> Text:
    """Write a verdict in its colour, with the limit that was hit."""
    shown = f'{verdict.value} ({reason})' if reason else verdict.value
    return Text(shown, style=_COLOURS[verdict])
