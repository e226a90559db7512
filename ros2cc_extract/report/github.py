"""
Findings as annotations of a GitHub workflow, and the whole list as its step summary.

Source: GitHub, "Workflow commands for GitHub Actions" (``::error file=…::``); only ten
annotations of a kind are shown per step, so the most important ones are written.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.fingerprints import relative
from ros2cc_extract.findings.model import Finding, Remark
from ros2cc_extract.report.counts import counted

SHOWN_PER_KIND = 10
_KINDS = {Severity.ERROR: 'error', Severity.WARNING: 'warning', Severity.NOTE: 'notice'}
_MARKS = {Severity.ERROR: '🔴', Severity.WARNING: '🟠', Severity.NOTE: '🔵'}


def workflow_commands(findings: Sequence[Finding], *, root: str = '') -> str:
    """Write the workflow commands, errors first; within a kind by code and place."""
    lines = []
    for severity in Severity:
        of_kind = sorted(
            (f for f in findings if f.severity is severity), key=lambda f: (f.code, f.place)
        )
        lines += [_command(finding, root) for finding in of_kind[:SHOWN_PER_KIND]]
    return ''.join(f'{line}\n' for line in lines)


def step_summary(
    findings: Sequence[Finding], summary: Mapping[str, int], *, root: str = ''
) -> str:
    """Write the whole list as Markdown, for the file ``$GITHUB_STEP_SUMMARY``."""
    counts = ', '.join(counted(number, what) for what, number in summary.items())
    lines = ['## ros2cc-extract', '', counts, '']
    if not findings:
        return '\n'.join([*lines, 'No findings.', ''])
    codes = Counter(finding.code for finding in findings)
    lines += [', '.join(f'{code}: {number}' for code, number in sorted(codes.items())), '']
    lines += ['| | code | place | what | help |', '|---|---|---|---|---|']
    lines += [_row(finding, root) for finding in findings]
    return '\n'.join([*lines, ''])


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
    place = remark.place
    line = f':{place.line}' if place.line else ''
    return f'{relative(place.file, root)}{line}: {remark.text}'


def _data(text: str) -> str:
    return text.replace('%', '%25').replace('\r', '%0D').replace('\n', '%0A')


def _property(text: str) -> str:
    return _data(text).replace(':', '%3A').replace(',', '%2C')


def _row(finding: Finding, root: str) -> str:
    place = f'{relative(finding.place.file, root)}:{finding.place.line}'
    cells = (finding.code, f'`{place}`', finding.message, finding.help)
    return f'| {_MARKS[finding.severity]} | ' + ' | '.join(map(_cell, cells)) + ' |'


def _cell(text: str) -> str:
    flat = ' '.join(text.split())
    return flat.replace('\\', '\\\\').replace('|', '\\|').replace('<', '&lt;')
