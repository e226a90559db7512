"""
Findings as annotations of a GitHub workflow, and the whole list as its step summary.

Source: GitHub, "Workflow commands for GitHub Actions" (``::error file=…::``); only ten
annotations of a kind are shown per step, so the most important ones are written.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.fingerprints import relative
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import printable

SHOWN_PER_KIND = 10
MOST_ROWS = 500
"""GitHub takes no step summary above 1 MiB; a row has some hundred bytes."""
_KINDS = {Severity.ERROR: 'error', Severity.WARNING: 'warning', Severity.NOTE: 'notice'}
_MARKS = {Severity.ERROR: '🔴', Severity.WARNING: '🟠', Severity.NOTE: '🔵'}


def workflow_commands(findings: Sequence[Finding], *, root: str = '') -> str:
    """Write the workflow commands, errors first; within a kind by code and place."""
    findings, lines = printable(findings), []
    for severity in Severity:
        of_kind = sorted(
            (f for f in findings if f.severity is severity), key=lambda f: (f.code, f.place)
        )
        lines += [_command(finding, root) for finding in of_kind[:SHOWN_PER_KIND]]
    return ''.join(f'{line}\n' for line in lines)


def step_summary(
    findings: Sequence[Finding], summary: Mapping[str, int], *, root: str = ''
) -> str:
    """
    Write the findings as Markdown, for the file ``$GITHUB_STEP_SUMMARY``.

    Errors first; notes are folded. Of more rows than ``MOST_ROWS`` the last are counted only.
    """
    findings = printable(findings)
    lines = ['## ros2cc-extract', '', last_line(summary), '']
    if not findings:
        return '\n'.join(lines)
    weight = list(Severity)
    ordered = sorted(findings, key=lambda finding: weight.index(finding.severity))
    main = [finding for finding in ordered if finding.severity is not Severity.NOTE]
    notes = ordered[len(main) :]
    if main:
        lines += [_counts(main), '', *_rows(main, MOST_ROWS, root)]
    if notes:
        title = f'{counted(len(notes), "notes")}: {_counts(notes)}'
        rows = _rows(notes, max(0, MOST_ROWS - len(main)), root)
        lines += [f'<details><summary>{title}</summary>', '', *rows, '</details>', '']
    return '\n'.join(lines)


def _counts(findings: Sequence[Finding]) -> str:
    codes = Counter(finding.code for finding in findings)
    return ', '.join(f'{code}: {number}' for code, number in sorted(codes.items()))


def _rows(findings: Sequence[Finding], most: int, root: str) -> list[str]:
    rows = [_row(finding, root) for finding in findings[:most]]
    head = ['| | code | place | what | help |', '|---|---|---|---|---|'] if rows else []
    left_out = len(findings) - len(rows)
    more = [f'{left_out} more: see the log, or --output-format json.', ''] if left_out else []
    return [*head, *rows, *([''] if rows else []), *more]


def _command(finding: Finding, root: str) -> str:
    place = finding.place
    parts = {
        'file': relative(place.file, root),
        'line': str(place.line) if place.line else '',
        'col': str(place.column) if place.column else '',
        'title': finding.code,
    }
    given = ','.join(f'{name}={_property(value)}' for name, value in parts.items() if value)
    return f'::{_KINDS[finding.severity]} {given}::{_data(_body(finding, root))}'


def _body(finding: Finding, root: str) -> str:
    lines = [finding.message, *(_remark(r, root) for r in (*finding.chain, *finding.related))]
    return '\n'.join([*lines, *([f'help: {finding.help}'] if finding.help else [])])


def _remark(remark: Remark, root: str) -> str:
    return f'{_shown(remark.place, root)}: {remark.text}'


def _shown(place: Place, root: str) -> str:
    line = f':{place.line}' if place.line else ''
    return f'{relative(place.file, root)}{line}'


def _data(text: str) -> str:
    return text.replace('%', '%25').replace('\r', '%0D').replace('\n', '%0A')


def _property(text: str) -> str:
    return _data(text).replace(':', '%3A').replace(',', '%2C')


def _row(finding: Finding, root: str) -> str:
    cells = (finding.code, f'`{_shown(finding.place, root)}`', finding.message, finding.help)
    return f'| {_MARKS[finding.severity]} | ' + ' | '.join(map(_cell, cells)) + ' |'


def _cell(text: str) -> str:
    flat = ' '.join(text.split())
    return flat.replace('\\', '\\\\').replace('|', '\\|').replace('<', '&lt;')
