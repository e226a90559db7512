"""The units of the page: an index, the worst first, and a section for each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from html import escape

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.promises import Judgement, Mark
from ros2cc_extract.report.html.findings import Numbered
from ros2cc_extract.report.html.parts import SEVERITY_WORDS, folded, items, span, tag
from ros2cc_extract.report.html.picture import unit_picture
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.unit_rows import (
    COLUMNS,
    SIGNS,
    Row,
    executor_words,
    short_executor,
)

MOST_OPEN = 3
"""More units than this are folded."""
_CLASSES = {Mark.KEPT: 'kept', Mark.BROKEN: 'broken', Mark.OPEN: 'undecided'}


def index(rows: Sequence[Row], findings: Sequence[Numbered]) -> str:
    """
    Write a row for each unit; nothing where there is only one.

    :param findings: of each row.
    """
    if len(rows) < 2:
        return ''
    heads = ('unit', 'executor', 'callbacks', *COLUMNS.values(), 'findings')
    head = tag('tr', *(tag('th', escape(each)) for each in heads))
    body = ''.join(_index_row(row, mine) for row, mine in zip(rows, findings, strict=True))
    table = tag('table', tag('thead', head), tag('tbody', body))
    title = tag('h2', 'Units ', span('quiet', f'{len(rows)}, worst first'))
    return tag('section', title, tag('div', table, class_='index', tabindex='0'), id='units')


def _index_row(row: Row, findings: Numbered) -> str:
    marks = (
        tag(
            'td',
            SIGNS[each.mark],
            class_=_CLASSES[each.mark],
            title=f'{each.promise.value}: {each.mark.value}',
        )
        for each in row.promises
    )
    return tag(
        'tr',
        tag('td', tag('a', escape(row.unit.name), href=f'#{anchor(row)}')),
        tag('td', escape(short_executor(row.unit.executor))),
        tag('td', str(len(row.unit.callbacks))),
        *marks,
        tag('td', _counts(findings)),
    )


def _counts(findings: Numbered) -> str:
    counts = Counter(finding.severity for _, finding in findings)
    return ' '.join(
        span(f'badge {word}', str(counts[severity]))
        for severity, word in SEVERITY_WORDS.items()
        if counts[severity]
    )


def anchor(row: Row) -> str:
    """Several units may have one name, so the place of the unit is its anchor."""
    return f'unit-{row.place}'


def unit_section(row: Row, findings: Numbered, verdicts: str, *, opened: bool) -> str:
    """Write one unit: what is proven of it, its findings, its picture and its verdicts."""
    callbacks = counted(len(row.unit.callbacks), 'callbacks')
    about = f' {executor_words(row.unit.executor)}, {callbacks}'
    entry = tag('p', escape(f'entry: {row.unit.entry}'), class_='quiet') if row.unit.entry else ''
    return folded(
        tag('h2', escape(f'Unit {row.unit.name}'), span('quiet', about)),
        entry,
        _promises(row.promises),
        _links(findings),
        unit_picture(row.unit, anchor(row), findings),
        verdicts,
        class_='unit',
        id=anchor(row),
        opened=opened,
    )


def _promises(promises: Sequence[Judgement]) -> str:
    return items((span(_CLASSES[each.mark], _words(each)) for each in promises), 'promises')


def _words(judgement: Judgement) -> str:
    reason = f': {judgement.reason}' if judgement.reason else ''
    return f'{SIGNS[judgement.mark]} {judgement.promise.value}{reason}'


def _links(findings: Numbered) -> str:
    """Notes are badges of the callbacks only."""
    return items(
        (
            tag('a', escape(f'{finding.code} {finding.place}'), href=f'#finding-{number}')
            for number, finding in findings
            if finding.severity is not Severity.NOTE
        ),
        'links',
    )
