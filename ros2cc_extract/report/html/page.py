"""
One self-contained page: findings, what the executors serve, verdicts, and runs to step through.

Everything is in the file: no font, script or picture is loaded. Times and memory are left out,
so that the same input gives the same bytes.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from importlib.resources import files
from typing import Any

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.report.html.findings import finding_card
from ros2cc_extract.report.html.parts import SEVERITY_WORDS, Sources, span, tag
from ros2cc_extract.report.html.unit import Numbered, unit_picture
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.finding_units import is_about
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.report.shared.run_endings import closing_lines
from ros2cc_extract.report.shared.run_lanes import Lane, lanes_of
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.text_escaping import one_line, printable
from ros2cc_extract.verify.results.evidence import Evidence, Moment
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification
from ros2cc_extract.version import __version__

BLOCKED = 'blocked'
"""Location of a thread whose callback waits, in the models of profile ``rclpy``."""
MOST_NOTES = 10
"""More notes than this are folded."""
_VERDICT_CLASSES = {
    Verdict.SATISFIED: 'satisfied',
    Verdict.NOT_SATISFIED: 'not-satisfied',
    Verdict.UNDECIDED: 'undecided',
}


@dataclass
class _Runs:
    """The runs on the page; one that several parts show is stored once."""

    callbacks: Sequence[str] = ()
    kept: list[tuple[Evidence, dict[str, Any]]] = field(default_factory=list)

    def timeline(self, run: Evidence) -> str:
        """Give the place of a timeline, which the script fills, with the steps as text."""
        number = next((n for n, (known, _) in enumerate(self.kept) if known is run), None)
        if number is None:
            number = len(self.kept)
            self.kept.append((run, _run_data(run, self.callbacks)))
        steps = ''.join(_step_text(moment, run) for moment in run.moments)
        closing = ''.join(tag('p', escape(line), class_='closing') for line in closing_lines(run))
        return tag('div', tag('ol', steps), class_='timeline', data_run=str(number)) + closing


def html_report(
    units: Sequence[Spec],
    verifications: Sequence[Verification],
    findings: Sequence[Finding],
    summary: Mapping[str, int],
    sources: Sources,
) -> str:
    """
    Write the report of a check.

    :param verifications: of the units, in their order; empty when none was verified.
    :param sources: text of the files named by places; an excerpt is left out where one is not.
    """
    units, findings = printable(units), printable(findings)
    verifications = printable(verifications)
    sources = {one_line(file): text for file, text in sources.items()}
    runs = _Runs()
    numbered = list(enumerate(findings, start=1))
    names = {unit.name: [callback.name for callback in unit.callbacks] for unit in units}
    cards = []
    for number, finding in _by_weight(numbered):
        runs.callbacks = names.get(finding.unit or '', ())
        cards.append((finding, finding_card(number, finding, sources, runs.timeline)))
    verdicts: Sequence[Verification | None] = verifications or [None] * len(units)
    sections = []
    for unit, verification in zip(units, verdicts, strict=True):
        runs.callbacks = names[unit.name]
        mine = [(number, f) for number, f in numbered if is_about(f, unit, units)]
        sections.append(_unit_section(unit, verification, mine, runs))
    body = _header(findings, summary) + _findings(cards) + ''.join(sections)
    return _page(body, [data for _, data in runs.kept])


def _by_weight(numbered: Numbered) -> Numbered:
    weight = list(Severity)
    return sorted(numbered, key=lambda entry: weight.index(entry[1].severity))


def _header(findings: Sequence[Finding], summary: Mapping[str, int]) -> str:
    counts = Counter(finding.severity for finding in findings)
    tiles = ''.join(
        tag(
            'button',
            tag('b', str(counts[severity])),
            escape(f'{word}{"" if counts[severity] == 1 else "s"}'),
            class_=f'tile {word}',
            data_filter=word,
            aria_pressed='false',
        )
        for severity, word in SEVERITY_WORDS.items()
    )
    facts = escape(last_line(summary))
    return tag(
        'header',
        tag('div', tag('h1', 'ros2cc-extract'), tag('p', facts, class_='quiet')),
        tag('div', tiles, class_='tiles'),
        tag('button', '◐', class_='theme', title='light or dark'),
        class_='top',
    )


def _findings(cards: Sequence[tuple[Finding, str]]) -> str:
    """Many notes are folded, so that errors and units stay in sight."""
    notes = [card for finding, card in cards if finding.severity is Severity.NOTE]
    others = [card for finding, card in cards if finding.severity is not Severity.NOTE]
    if len(notes) > MOST_NOTES:
        summary = tag('summary', counted(len(notes), 'notes'))
        notes = [tag('details', summary, *notes, class_='notes')]
    content = ''.join((*others, *notes)) or tag('p', 'No findings.', class_='quiet')
    return tag('section', tag('h2', 'Findings'), content)


def _unit_section(
    unit: Spec, verification: Verification | None, findings: Numbered, runs: _Runs
) -> str:
    entry = tag('p', escape(f'entry: {unit.entry}'), class_='quiet') if unit.entry else ''
    return tag(
        'section',
        tag('h2', escape(f'Unit {unit.name}')),
        entry,
        unit_picture(unit, findings),
        _verdicts(verification, runs) if verification else '',
        id=f'unit-{unit.name}',
    )


def _verdicts(verification: Verification, runs: _Runs) -> str:
    rows = ''.join(
        _verdict_row(number, result, runs)
        for number, result in enumerate(verification.results, start=1)
    )
    counts = Counter(result.verdict for result in verification.results)
    words = ', '.join(f'{counts[v]} {v.value}' for v in Verdict if counts[v])
    assumed = ''.join(
        tag('p', escape(f'assumed: {text}'), class_='quiet') for text in verification.assumptions
    )
    model = ' '.join(filter(None, (verification.profile, verification.text)))
    cost = f'{verification.states} states, {verification.transitions} transitions, {model} model'
    return tag(
        'details',
        tag('summary', tag('b', 'Verdicts'), escape(f' {words} '), span('quiet', cost)),
        assumed,
        tag('div', rows, class_='verdicts'),
        class_='verdict-table',
    )


def _verdict_row(number: int, result: QueryResult, runs: _Runs) -> str:
    kind = _VERDICT_CLASSES[result.verdict]
    reason = f' ({result.reason})' if result.reason else ''
    line = (
        span('quiet number', str(number))
        + span('words', result.words)
        + span(f'verdict {kind}', f'{result.verdict.value}{reason}')
    )
    if result.evidence is None:
        return tag('div', line, class_='row')
    formula = tag('p', tag('code', escape(result.formula)))
    return tag(
        'details', tag('summary', line, class_='row'), formula, runs.timeline(result.evidence)
    )


def _step_text(moment: Moment, run: Evidence) -> str:
    said = '; '.join(sentence.text for sentence in moment.sentences)
    again = 'from here for ever: ' if moment.number == run.cycle_from else ''
    return tag('li', escape(again + said))


def _run_data(run: Evidence, callbacks: Sequence[str]) -> dict[str, Any]:
    numbers = {name: number % 8 for number, name in enumerate(callbacks)}
    return {
        'lanes': [_lane_data(lane, numbers) for lane in lanes_of(run, callbacks)],
        'steps': [_step_data(moment, run) for moment in run.moments],
        'cycleFrom': run.cycle_from,
        'ends': run.ends,
    }


def _lane_data(lane: Lane, numbers: Mapping[str, int]) -> dict[str, Any]:
    return {
        'name': lane.process,
        'stays': [
            {
                'text': f'{stay.callback}: {stay.location}' if stay.callback else stay.location,
                'since': stay.since,
                'until': stay.until,
                'rest': stay.is_rest,
                'blocked': stay.location == BLOCKED,
                'colour': numbers.get(stay.callback or lane.process),
            }
            for stay in lane.stays
        ],
    }


def _step_data(moment: Moment, run: Evidence) -> dict[str, Any]:
    return {
        'says': [[sentence.lane, sentence.text] for sentence in moment.sentences],
        'places': [[name, str(place)] for name, place in moment.places],
        'changes': [
            f'{name} = {value}' for name, value in moment.changes.items() if name not in run.start
        ],
    }


def _page(body: str, runs: Sequence[Mapping[str, Any]]) -> str:
    data = json.dumps(runs, ensure_ascii=False).replace('</', '<\\/').replace('<!', '<\\u0021')
    return f"""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="ros2cc-extract {__version__}">
<title>ros2cc-extract</title>
<style>
{_asset('report.css')}</style>
</head>
<body>
{body}
<script type="application/json" id="runs">{data}</script>
<script>
{_asset('report.js')}</script>
</body>
</html>
"""


def _asset(name: str) -> str:
    folder = files('ros2cc_extract.report.html').joinpath('assets')
    return folder.joinpath(name).read_text(encoding='utf-8')
