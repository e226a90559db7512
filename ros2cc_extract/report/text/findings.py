"""Findings as ``path:line:col: CODE message`` with the source line and a caret."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.text import Text

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.files import read_regular
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.places import Place
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.text.verdicts import print_run
from ros2cc_extract.shown import one_line

MOST_RELATED = 8
MOST_BYTES = 8_000_000
_LINE_END = re.compile('\r\n|\r|\n')
"""As Python counts lines: a form feed ends none."""
_COLOURS = {Severity.ERROR: 'red', Severity.WARNING: 'magenta', Severity.NOTE: 'cyan'}


def print_findings(findings: Sequence[Finding], root: Path, console: Console) -> None:
    """Print each finding with its source line, evidence and help."""
    for finding in findings:
        _print_head(finding, console)
        for line in source_excerpt(finding.place, root):
            console.print(line, soft_wrap=True)
        for remark in (*finding.chain, *finding.related[:MOST_RELATED]):
            told = f'{remark.place}: {remark.text}'
            console.print(f'  {one_line(told)}', soft_wrap=True)
        if len(finding.related) > MOST_RELATED:
            left_out = counted(len(finding.related) - MOST_RELATED, 'places')
            console.print(f'  and {left_out} more: see --output-format html')
        if finding.run is not None:
            console.print('  it can happen like this:')
            print_run(finding.run, console)
        if finding.help:
            console.print(f'  help: {one_line(finding.help)}', soft_wrap=True)


def print_in_lines(findings: Sequence[Finding], console: Console) -> None:
    """Print each finding on one line, without source and evidence."""
    for finding in findings:
        _print_head(finding, console)


def _print_head(finding: Finding, console: Console) -> None:
    head = Text(one_line(f'{finding.place}: '))
    head.append(finding.code, style=_COLOURS[finding.severity])
    head.append(one_line(f' {finding.message}'))
    console.print(head, soft_wrap=True)


def source_excerpt(place: Place, root: Path) -> list[str]:
    """Give the source line and a caret below it; nothing when the file cannot be read."""
    if not place.line:
        return []
    try:
        text = read_regular(root / place.file, MOST_BYTES).decode(errors='replace')
    except OSError:
        return []
    lines = _LINE_END.split(text)
    if place.line > len(lines):
        return []
    line = lines[place.line - 1]
    shown = [f'{place.line:5} | {one_line(line.expandtabs(4))}']
    if place.column:
        indent = len(one_line(line[: place.column - 1].expandtabs(4)))
        shown.append(f'      | {" " * indent}^')
    return shown
