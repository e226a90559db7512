"""The cards of the findings: line, reason, evidence, help, and the page of the rule."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from html import escape

from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.base.rule import Rule
from ros2cc_extract.findings.rules.registry import BY_CODE
from ros2cc_extract.report.html.parts import (
    SEVERITY_WORDS,
    Sources,
    excerpt,
    place_text,
    prose,
    span,
    tag,
)
from ros2cc_extract.verify.results.evidence import Evidence

Timeline = Callable[[Evidence], str]


def finding_card(number: int, finding: Finding, sources: Sources, timeline: Timeline) -> str:
    """Write one finding; ``number`` is its anchor."""
    kind = SEVERITY_WORDS[finding.severity]
    run = (
        tag('h4', 'A run of the model that shows it') + timeline(finding.run)
        if finding.run
        else ''
    )
    return tag(
        'article',
        tag(
            'header',
            span(f'badge {kind}', finding.code),
            tag('h3', escape(finding.message)),
        ),
        tag('p', place_text(finding.place), _of_unit(finding)),
        excerpt(finding.place, sources),
        _remarks('How it gets there', finding.chain, sources),
        _remarks('Look also at', finding.related, sources),
        tag('p', tag('b', 'help: '), escape(finding.help), class_='help') if finding.help else '',
        run,
        _rule_page(BY_CODE[finding.code]),
        class_=f'finding {kind}',
        id=f'finding-{number}',
        data_kind=kind,
    )


def _of_unit(finding: Finding) -> str:
    return span('quiet', f' in unit {finding.unit}') if finding.unit else ''


def _remarks(title: str, remarks: Iterable[Remark], sources: Sources) -> str:
    rows = ''.join(
        tag(
            'li',
            escape(remark.text),
            ' ',
            place_text(remark.place),
            excerpt(remark.place, sources, around=0),
        )
        for remark in remarks
    )
    return tag('h4', title) + tag('ol', rows, class_='remarks') if rows else ''


def _rule_page(rule: Rule) -> str:
    return tag(
        'details',
        tag('summary', f'{rule.code} {rule.slug}: {escape(rule.title)}'),
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
    )
