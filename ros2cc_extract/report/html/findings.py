"""The cards of the findings: line, reason, evidence and help; and the pages of their rules."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding, OnNode, Remark
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.rules.registry import BY_CODE
from ros2cc_extract.report.html.excerpts import AROUND, Excerpts
from ros2cc_extract.report.html.parts import SEVERITY_WORDS, folded, prose, span, tag
from ros2cc_extract.report.html.runs import Runs, steps_as_text
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.spec.model import Spec

MOST_NOTES = 10
"""More notes than this are folded."""
MOST_OPEN = 3
"""More runs than this are drawn when they are asked for."""

Numbered = Sequence[tuple[int, Finding]]
"""The findings of the page with their numbers, which are their anchors."""


def by_weight(findings: Iterable[Finding]) -> Numbered:
    """Number the findings, errors first."""
    weight = list(Severity)
    ordered = sorted(findings, key=lambda finding: weight.index(finding.severity))
    return list(enumerate(ordered, start=1))


def findings_section(
    findings: Numbered, units: Sequence[Spec], excerpts: Excerpts, runs: Runs
) -> str:
    """Write all findings; many notes are folded, so that errors and units stay in sight."""
    named = {unit.name: unit for unit in units}
    opened = sum(finding.run is not None for _, finding in findings) <= MOST_OPEN
    cards: dict[bool, list[str]] = {False: [], True: []}
    for number, finding in findings:
        run = _run(finding, named.get(finding.unit or ''), runs, opened=opened)
        card = _card(number, finding, excerpts, run)
        cards[finding.severity is Severity.NOTE].append(card)
    others, notes = cards[False], cards[True]
    if len(notes) > MOST_NOTES:
        notes = [folded(counted(len(notes), 'notes'), *notes, class_='notes')]
    content = ''.join((*others, *notes)) or tag('p', 'No findings.', class_='quiet')
    return tag('section', tag('h2', 'Findings'), content, id='findings')


def rules_section(findings: Numbered) -> str:
    """Write what each rule means, once."""
    codes = sorted({finding.code for _, finding in findings})
    pages = ''.join(_rule_page(BY_CODE[code]) for code in codes)
    return tag('section', tag('h2', 'Rules'), pages, id='rules') if pages else ''


def _card(number: int, finding: Finding, excerpts: Excerpts, run: str) -> str:
    kind = SEVERITY_WORDS[finding.severity]
    rule = BY_CODE[finding.code]
    about = f'{rule.code} {rule.slug}: {rule.title}'
    return tag(
        'article',
        tag(
            'header',
            span(f'badge {kind}', finding.code),
            tag('h3', escape(finding.message)),
        ),
        tag('p', excerpts.link(finding.place, AROUND), _of_unit(finding)),
        _remarks('How it gets there', finding.chain, excerpts),
        _remarks('Look also at', finding.related, excerpts),
        run,
        _on_node(finding.on_node) if finding.on_node else '',
        tag('p', tag('b', 'help: '), escape(finding.help), class_='help') if finding.help else '',
        tag('p', tag('a', escape(about), href=f'#rule-{rule.code}'), class_='about'),
        class_=f'finding {kind}',
        id=f'finding-{number}',
        data_kind=kind,
    )


def _of_unit(finding: Finding) -> str:
    return span('quiet', f' in unit {finding.unit}') if finding.unit else ''


def _on_node(found: OnNode) -> str:
    """What the running node did, below what the model says."""
    steps = ''.join(tag('li', escape(step)) for step in found.run)
    run = tag('ol', steps, class_='steps') if steps else ''
    lines = '\n'.join(map(escape, found.evidence.splitlines()))
    evidence = tag('pre', lines, class_='evidence') if lines else ''
    return tag('h4', 'On the running node') + tag('p', escape(found.words)) + run + evidence


def _run(finding: Finding, unit: Spec | None, runs: Runs, *, opened: bool) -> str:
    if finding.run is None:
        return ''
    player = runs.player(finding.run, unit, opened=opened)
    return tag('h4', 'It can happen like this') + steps_as_text(finding.run) + player


def _remarks(title: str, remarks: Iterable[Remark], excerpts: Excerpts) -> str:
    rows = ''.join(
        tag('li', escape(remark.text), ' ', excerpts.link(remark.place)) for remark in remarks
    )
    return tag('h4', title) + tag('ol', rows, class_='remarks') if rows else ''


def _rule_page(rule: Rule) -> str:
    return folded(
        f'{rule.code} {rule.slug}: {escape(rule.title)}',
        tag('p', prose(rule.what)),
        tag('p', prose(rule.why)),
        tag(
            'div',
            tag('div', tag('h4', 'Example'), tag('pre', escape(rule.bad), class_='source')),
            tag('div', tag('h4', 'Mended'), tag('pre', escape(rule.good), class_='source')),
            class_='pair',
        ),
        tag('p', prose(rule.mend)),
        class_='rule',
        id=f'rule-{rule.code}',
    )
