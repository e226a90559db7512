"""The table of differences between two specifications."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from ros2cc_extract.compare.merge import Difference
from ros2cc_extract.report.text.style import table
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import printable


def print_differences(
    differences: Sequence[Difference], names: tuple[str, str], console: Console
) -> None:
    """Print one row per difference; those that one side announced come last."""
    differences, names = printable(differences), printable(names)
    if not differences:
        console.print(f'no difference between {names[0]} and {names[1]}')
        return
    rows = table('unit', 'what', 'fact', *names, '')
    for difference in sorted(differences, key=lambda difference: difference.marked):
        rows.add_row(
            difference.unit,
            difference.subject,
            difference.fact,
            _side(difference.left, difference.left_place),
            _side(difference.right, difference.right_place),
            'announced' if difference.marked else difference.kind.value,
        )
    console.print(rows)
    faults = sum(not difference.marked for difference in differences)
    noun = 'difference' if faults == 1 else 'differences'
    console.print(f'{faults} {noun}, {len(differences) - faults} announced')


def _side(value: str, place: Place | None) -> str:
    return f'{value or "-"} ({place})' if place else value or '-'
