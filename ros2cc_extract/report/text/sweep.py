"""The table of a sweep: queries down, thread counts across."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from rich.console import Console
from rich.text import Text

from ros2cc_extract.report.text.style import table
from ros2cc_extract.text_escaping import printable
from ros2cc_extract.verify.results.results import Verdict
from ros2cc_extract.verify.sweep import Point, Sweep

_SIGNS = {
    Verdict.SATISFIED: Text('yes', style='green'),
    Verdict.NOT_SATISFIED: Text('no', style='red'),
    Verdict.UNDECIDED: Text('?', style='yellow'),
}


def print_sweep(sweep: Sweep, console: Console) -> None:
    """Print one column per point, then what follows from it."""
    sweep = printable(sweep)
    bounds = {point.max_cycle for point in sweep.points}
    rows = table('  #', 'query', *(_head(point, len(bounds) > 1) for point in sweep.points))
    first = sweep.verifications[0]
    for index, result in enumerate(first.results):
        verdicts = [verification.results[index].verdict for verification in sweep.verifications]
        signs = (_SIGNS[verdict] for verdict in verdicts)
        is_last = index + 1 == len(first.results)
        rows.add_row(f'{index + 1:3}', result.words, *signs, end_section=is_last)
    rows.add_row('', 'states', *(str(v.states) for v in sweep.verifications))
    rows.add_row('', 'seconds', *(f'{v.seconds:.2f}' for v in sweep.verifications))
    console.print(f'unit {sweep.unit}: yes = satisfied, no = not satisfied, ? = undecided')
    console.print(rows)
    for note in dict.fromkeys(note for v in sweep.verifications for note in v.notes):
        console.print(f'  note: {note}', soft_wrap=True)
    for line in _conclusion(sweep, with_bound=len(bounds) > 1):
        console.print(f'  {line}', soft_wrap=True)


def _conclusion(sweep: Sweep, *, with_bound: bool) -> Iterator[str]:
    """What to do first, then which rows turn: one line per thread count and direction."""
    least = sweep.least_threads()
    if least is not None:
        yield f'smallest number of threads without a deadlock: {least}'
    elif sweep.asks_for_progress:
        yield 'none of these numbers of threads is shown to be free of a deadlock'
    families = [result.family or 'query' for result in sweep.verifications[0].results]
    by_count = groupby(sweep.turns(), key=lambda turn: (turn.threads, turn.max_cycle))
    for (threads, max_cycle), turns in by_count:
        yield f'from {threads} threads on{f" (max-cycle {max_cycle})" if with_bound else ""}:'
        by_direction: dict[str, list[int]] = {}
        for turn in turns:
            direction = f'{turn.before.value} -> {turn.after.value}'
            by_direction.setdefault(direction, []).append(turn.query)
        for direction, queries in by_direction.items():
            yield f'  {direction}: {_rows_by_family(queries, families)}'


def _rows_by_family(queries: Sequence[int], families: Sequence[str]) -> str:
    """Rows of the table, as spans, with the family that they are of."""
    by_family: dict[str, list[int]] = {}
    for query in queries:
        by_family.setdefault(families[query - 1].replace('_', ' '), []).append(query)
    return '; '.join(f'{family} {_spans(rows)}' for family, rows in by_family.items())


def _spans(rows: Sequence[int]) -> str:
    """Ascending numbers, neighbours drawn together: ``5-7, 9``."""
    spans: list[tuple[int, int]] = []
    for row in rows:
        if spans and spans[-1][1] == row - 1:
            spans[-1] = (spans[-1][0], row)
        else:
            spans.append((row, row))
    return ', '.join(str(a) if a == b else f'{a}-{b}' for a, b in spans)


def _head(point: Point, with_bound: bool) -> str:
    threads = f'{point.threads} thread{"s" if point.threads != 1 else ""}'
    return f'{threads}, cycle {point.max_cycle or "inf"}' if with_bound else threads
