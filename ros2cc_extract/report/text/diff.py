"""The table of differences between two specifications."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rich.console import Console

from ros2cc_extract.compare.merge import NOT_KNOWN, Difference, Kind
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


def difference_lines(differences: Sequence[Difference], names: tuple[str, str]) -> Iterator[str]:
    """One line for each difference of two sides that are joined, those first that are faults."""
    differences, names = printable(differences), printable(names)
    for each in sorted(differences, key=lambda difference: difference.marked):
        place = each.left_place or each.right_place
        where = f'{place}: ' if place else ''
        of_unit = '' if each.subject == each.unit else f'{each.unit}: '
        about = 'note' if each.marked else 'warning'
        yield f'{where}{about}: {of_unit}{_words(each, names)}'


def _words(each: Difference, names: tuple[str, str]) -> str:
    subject = f'{each.fact} {each.subject}' if each.subject == each.unit else each.subject
    if each.kind in (Kind.ONLY_LEFT, Kind.ONLY_RIGHT):
        here, there = names if each.kind is Kind.ONLY_LEFT else names[::-1]
        return f'{subject} is in {here} and not in {there}'
    if not each.right:
        return f'{subject} is {each.left}'
    other = f' ({each.right_place})' if each.right_place else ''
    what = f'{each.left} in {names[0]}, {each.right} in {names[1]}{other}'
    kept = 'the second is taken' if each.left == NOT_KNOWN else 'the first is kept'
    return f'{each.fact} of {each.subject}: {what}; {kept}'


def _side(value: str, place: Place | None) -> str:
    return f'{value or "-"} ({place})' if place else value or '-'
