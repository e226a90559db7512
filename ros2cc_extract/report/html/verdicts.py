"""The verdicts of a unit: a row for each query, and the run behind it."""

from __future__ import annotations

from collections import Counter
from html import escape

from ros2cc_extract.report.html.parts import folded, span, tag
from ros2cc_extract.report.html.runs import Runs
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

_CLASSES = {
    Verdict.SATISFIED: 'satisfied',
    Verdict.NOT_SATISFIED: 'not-satisfied',
    Verdict.UNDECIDED: 'undecided',
}


def verdict_table(verification: Verification, unit: Spec, runs: Runs) -> str:
    """Write all verdicts of a unit, folded."""
    rows = ''.join(
        _row(number, result, unit, runs)
        for number, result in enumerate(verification.results, start=1)
    )
    counts = Counter(result.verdict for result in verification.results)
    words = ', '.join(f'{counts[v]} {v.value}' for v in Verdict if counts[v])
    assumed = ''.join(
        tag('p', escape(f'assumed: {text}'), class_='quiet') for text in verification.assumptions
    )
    model = ' '.join(filter(None, (verification.profile, verification.text)))
    cost = f'{verification.states} states, {verification.transitions} transitions, {model} model'
    return folded(
        tag('b', 'Verdicts') + escape(f' {words} ') + span('quiet', cost),
        assumed,
        tag('div', rows, class_='verdicts'),
        class_='verdict-table',
    )


def _row(number: int, result: QueryResult, unit: Spec, runs: Runs) -> str:
    reason = f' ({result.reason})' if result.reason else ''
    verdict = f'{result.verdict.value}{reason}'
    line = (
        span('quiet number', str(number))
        + span('words', result.words)
        + span(f'verdict {_CLASSES[result.verdict]}', verdict)
    )
    if result.evidence is None:
        return tag('div', line, class_='row')
    return folded(
        tag('div', line, class_='row'),
        tag('p', tag('code', escape(result.formula))),
        data_run=str(runs.number(result.evidence, unit)),
    )
