"""One console for every text report: the same lines on a terminal and in a log."""

from __future__ import annotations

import os
from typing import TextIO

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ros2cc_extract.verify import Verdict

LOG_WIDTH = 120

_COLOURS = {
    Verdict.SATISFIED: 'green',
    Verdict.NOT_SATISFIED: 'red',
    Verdict.UNDECIDED: 'yellow',
}


def console_for(stream: TextIO) -> Console:
    """Make a console; where the stream is no terminal the width does not depend on the machine."""
    is_terminal = stream.isatty()
    width = None if is_terminal or 'COLUMNS' in os.environ else LOG_WIDTH
    return Console(file=stream, width=width, highlight=False, markup=False, emoji=False)


def table(*headers: str) -> Table:
    """Make a table without frames, which survives copying into an issue."""
    made = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style='bold')
    for header in headers:
        made.add_column(header, overflow='fold')
    return made


def verdict_text(verdict: Verdict, reason: str | None = None) -> Text:
    """Write a verdict in its colour, with the limit that was hit."""
    shown = f'{verdict.value} ({reason})' if reason else verdict.value
    return Text(shown, style=_COLOURS[verdict])
