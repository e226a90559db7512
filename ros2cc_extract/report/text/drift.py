"""The changes against a committed specification, one line each."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from ros2cc_extract.compare.drift import Drift
from ros2cc_extract.text_escaping import printable


def print_drift(found: Sequence[Drift], committed: str, console: Console) -> None:
    """Print ``place: unit: subject change``; what has no place now is at the committed file."""
    found, committed = printable(found), printable(committed)
    for each in found:
        where = each.place or committed
        console.print(f'{where}: {each.unit}: {each.subject} {each.change}', soft_wrap=True)
    if not found:
        console.print(f'no drift from {committed}')
