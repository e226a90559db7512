"""The verdict table and the runs behind it, for people."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from rich.console import Console

from ros2cc_extract.report.shared.run_endings import closing_lines
from ros2cc_extract.report.text.spec import short
from ros2cc_extract.report.text.style import print_rows, table, verdict_text
from ros2cc_extract.text_escaping import one_line
from ros2cc_extract.verify.results.evidence import Evidence, Moment
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

LISTED_SUBJECTS = 20
MOST_ROWS, ROWS_OF_A_KIND = 2_000, 200
"""A table of more rows shows the first of each family and verdict, and counts the others."""
_LISTED = (
    ('can never run', 'executable', Verdict.NOT_SATISFIED),
    ('can run at the same time', 'can overlap', Verdict.SATISFIED),
    ('may starve', 'starvation', Verdict.NOT_SATISFIED),
)


def print_table(verification: Verification, console: Console, *, details: bool) -> None:
    """
    Print one row per query, in the order of the ``.q`` file.

    :param details: with expression and time, as the paper's table has them.
    """
    # Foreign queries may have no words but their expression.
    has_words = any(result.words != result.formula for result in verification.results)
    titles = ['expression', 'verdict', 'time'] if details else ['verdict']
    rows = table('  #', *(['query'] if has_words or not details else []), *titles)
    for number, result in _listed(verification):
        verdict = verdict_text(result.verdict, result.reason)
        if result.load is not None:
            verdict.append(f'; {result.load.words}', style='default')
        expert = [result.formula, verdict, f'{result.seconds:.3f} s']
        words = [result.words] if has_words or not details else []
        rows.add_row(f'{number:3}', *words, *(expert if details else [verdict]))
    console.print(rows)
    for line in _unlisted(verification):
        console.print(f'  {line}')
    _print_footer(verification, console, details=details)


def _listed(verification: Verification) -> Iterator[tuple[int, QueryResult]]:
    """Give the rows to show, with the number that each query has."""
    is_long = len(verification.results) > MOST_ROWS
    seen: Counter[tuple[str | None, Verdict]] = Counter()
    for number, result in enumerate(verification.results, start=1):
        kind = result.family, result.verdict
        seen[kind] += 1
        if not is_long or seen[kind] <= ROWS_OF_A_KIND:
            yield number, result


def _unlisted(verification: Verification) -> Iterator[str]:
    """Say of how many queries there is no row."""
    if len(verification.results) <= MOST_ROWS:
        return
    kinds = Counter((result.family, result.verdict) for result in verification.results)
    for (family, verdict), count in kinds.items():
        if count > ROWS_OF_A_KIND:
            words = (family or 'query').replace('_', ' ')
            yield f'and {count - ROWS_OF_A_KIND} more, {words}: {verdict.value}'
    yield '--output-format json lists all of them'


def _print_footer(verification: Verification, console: Console, *, details: bool) -> None:
    console.print(f'  {_size(verification, details=details)}')
    for note in (*verification.notes, *_caveats(verification)):
        console.print(f'  note: {note}')
    for assumption in verification.assumptions:
        console.print(f'  assumed: {assumption}')


def print_digest(verification: Verification, console: Console) -> None:
    """Print what a table of hundreds of rows says, family by family."""
    rows = table('  claim', 'satisfied', 'not satisfied', 'undecided')
    for family, results in _by_family(verification).items():
        counts = Counter(result.verdict for result in results)
        rows.add_row(f'  {family}', *(str(counts[verdict] or '-') for verdict in Verdict))
    console.print(rows)
    for title, family, verdict in _LISTED:
        subjects = [
            ' with '.join(result.callbacks)
            for result in _by_family(verification).get(family, ())
            if result.verdict is verdict
        ]
        if subjects:
            console.print(f'  {title}: {_shortened(subjects)}')
    _print_footer(verification, console, details=False)


def _by_family(verification: Verification) -> dict[str, list[QueryResult]]:
    families: dict[str, list[QueryResult]] = {}
    for result in verification.results:
        families.setdefault((result.family or 'query').replace('_', ' '), []).append(result)
    return families


def _shortened(subjects: list[str]) -> str:
    shown = '; '.join(subjects[:LISTED_SUBJECTS])
    left_out = len(subjects) - LISTED_SUBJECTS
    return f'{shown} and {left_out} more' if left_out > 0 else shown


def print_evidence(
    numbered: Iterable[tuple[int, QueryResult]], console: Console, *, changes: bool = False
) -> None:
    """Print the run behind each verdict that has one."""
    for number, result in numbered:
        if result.evidence is not None:
            word = 'witness' if _is_witness(result) else 'counterexample'
            console.print(f'{word} for {number}: {result.words}: {result.verdict.value}')
            print_run(result.evidence, console, changes=changes)


def _caveats(verification: Verification) -> Iterator[str]:
    starving = (r for r in verification.results if r.family == 'starvation')
    if verification.profile == 'paper' and any(
        r.verdict is Verdict.NOT_SATISFIED for r in starving
    ):
        yield (
            'starvation is decided as published, where unserved data may vanish; rclpy keeps it '
            '(docs/model.md)'
        )


def _is_witness(result: QueryResult) -> bool:
    return result.verdict is Verdict.SATISFIED


def _size(verification: Verification, *, details: bool) -> str:
    model = ' '.join(filter(None, (verification.profile, verification.text)))
    complete = '' if verification.complete else ', stopped by a limit'
    cost = f', {verification.seconds:.3f} s, peak memory {verification.peak_mb:.0f} MB'
    return (
        f'{verification.states} states, {verification.transitions} transitions'
        f'{cost if details else ""}{complete} '
        f'({model + " model, " if model else ""}{verification.engine} checker)'
    )


def print_run(evidence: Evidence, console: Console, *, changes: bool = False) -> None:
    """Print the steps of a run, numbered, with the places of the callbacks they name."""
    print_rows(list(_run_rows(evidence, changes)), console, indent=2)
    for line in closing_lines(evidence):
        console.print(f'       {one_line(line)}', soft_wrap=True)


def _run_rows(evidence: Evidence, changes: bool) -> Iterator[tuple[str, str, str]]:
    for moment in evidence.moments:
        if moment.number == evidence.cycle_from:
            yield '', 'and then forever:', ''
        words = '; '.join(sentence.text for sentence in moment.sentences)
        yield f'{moment.number:3}', words, _places(moment)
        if changes and moment.changes:
            changed = ', '.join(f'{name} = {value}' for name, value in moment.changes.items())
            yield '', f'[{changed}]', ''
    if not evidence.moments:
        yield '', 'the initial state already shows it', ''
    if evidence.ends and not evidence.closing:
        yield '', _ENDS.get(evidence.ends, evidence.ends), ''


def _places(moment: Moment) -> str:
    return ', '.join(dict.fromkeys(short(place) for _, place in moment.places))


_ENDS = {
    'deadlock': 'nothing can move any more',
    'idle': 'it may stay like this forever',
}
