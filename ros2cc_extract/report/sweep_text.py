"""The table of a sweep: queries down, thread counts across."""

from __future__ import annotations

from rich.console import Console
from rich.text import Text

from ros2cc_extract.report.style import table
from ros2cc_extract.verify.sweep import Point, Sweep
from ros2cc_extract.verify.unit import Verdict

_SIGNS = {
    Verdict.SATISFIED: Text('yes', style='green'),
    Verdict.NOT_SATISFIED: Text('no', style='red'),
    Verdict.UNDECIDED: Text('?', style='yellow'),
}


def print_sweep(sweep: Sweep, console: Console) -> None:
    """Print one column per point, then from which thread count on a verdict is another one."""
    bounds = {point.max_cycle for point in sweep.points}
    rows = table('  #', 'query', *(_head(point, len(bounds) > 1) for point in sweep.points))
    first = sweep.verifications[0]
    for index, result in enumerate(first.results):
        verdicts = [verification.results[index].verdict for verification in sweep.verifications]
        rows.add_row(f'{index + 1:3}', result.words, *(_SIGNS[verdict] for verdict in verdicts))
    rows.add_section()
    rows.add_row('', 'states', *(str(v.states) for v in sweep.verifications))
    rows.add_row('', 'seconds', *(f'{v.seconds:.2f}' for v in sweep.verifications))
    console.print(f'unit {sweep.unit}: yes = satisfied, no = not satisfied, ? = undecided')
    console.print(rows)
    for note in dict.fromkeys(note for v in sweep.verifications for note in v.notes):
        console.print(f'  note: {note}', soft_wrap=True)
    for turn in sweep.turns():
        words = first.results[turn.query - 1].words
        bound = f' (max-cycle {turn.max_cycle})' if len(bounds) > 1 else ''
        console.print(
            f'  from {turn.threads} threads on{bound}: {words}: {turn.before.value} -> '
            f'{turn.after.value}'
        )
    least = sweep.least_threads()
    if least is not None:
        console.print(f'  smallest number of threads without a dead-lock: {least}')


def _head(point: Point, with_bound: bool) -> str:
    threads = f'{point.threads} thread{"s" if point.threads != 1 else ""}'
    return f'{threads}, cycle {point.max_cycle or "inf"}' if with_bound else threads
