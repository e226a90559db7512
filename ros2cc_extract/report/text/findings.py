"""Findings as ``path:line:col: severity CODE: message`` with the source line and a caret."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from enum import Enum
from pathlib import Path

from rich.console import Console
from rich.style import Style
from rich.text import Text

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.files import read_regular
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.short_runs import shortened
from ros2cc_extract.report.text.paths import Paths
from ros2cc_extract.report.text.verdicts import print_run
from ros2cc_extract.source_locations import Place
from ros2cc_extract.text_escaping import one_line

MOST_RELATED = 8
MOST_STEPS = 8
MOST_NOTES = 10
"""More notes than this are counted by file."""
MOST_FILES = 10
"""Of more files than this the notes are counted together."""
MOST_BYTES = 8_000_000
_LINE_END = re.compile('\r\n|\r|\n')
"""As Python counts lines: a form feed ends none."""
_COLOURS = {Severity.ERROR: 'red', Severity.WARNING: 'magenta', Severity.NOTE: 'cyan'}


class Detail(Enum):
    """How much is reported."""

    QUIET = 'quiet'
    USUAL = 'usual'
    VERBOSE = 'verbose'


def print_findings(
    findings: Sequence[Finding], paths: Paths, console: Console, detail: Detail = Detail.USUAL
) -> None:
    """Print errors and warnings with what shows them, and notes on one line each."""
    notes = [finding for finding in findings if finding.severity is Severity.NOTE]
    for finding in findings:
        if finding.severity is Severity.NOTE and detail is not Detail.VERBOSE:
            continue
        _print_head(finding, paths, console)
        if detail is not Detail.QUIET:
            _print_body(finding, paths, console, detail)
    if detail is Detail.USUAL and len(notes) > MOST_NOTES:
        _print_counts(notes, paths, console)
    elif detail is not Detail.VERBOSE:
        for note in notes:
            _print_head(note, paths, console)


def _print_head(finding: Finding, paths: Paths, console: Console) -> None:
    place = paths.of(finding.place)
    head = Text(one_line(str(place)), style=Style(bold=True, link=paths.link(finding.place.file)))
    colour = _COLOURS[finding.severity]
    console.print(
        Text.assemble(
            head,
            ': ',
            (f'{finding.severity.value} {finding.code}', colour),
            one_line(f': {finding.message}'),
        ),
        soft_wrap=True,
    )


def _print_body(finding: Finding, paths: Paths, console: Console, detail: Detail) -> None:
    for line in source_excerpt(finding.place, paths.here):
        console.print(line, soft_wrap=True)
    remarks = paths.remarks(finding)
    for remark in remarks[: len(finding.chain) + MOST_RELATED]:
        console.print(f'  {one_line(f"{remark.place}: {remark.text}")}', soft_wrap=True)
    if len(finding.related) > MOST_RELATED:
        left_out = counted(len(finding.related) - MOST_RELATED, 'places')
        console.print(f'  and {left_out} more: see --output-format html')
    if finding.run is not None:
        is_whole = detail is Detail.VERBOSE
        console.print('  it can happen like this:')
        print_run(finding.run if is_whole else shortened(finding.run, MOST_STEPS), console)
    if finding.on_node is not None:
        console.print(f'  {one_line(finding.on_node.words)}', soft_wrap=True)
    if finding.help:
        console.print(f'  help: {one_line(finding.help)}', soft_wrap=True)


def _print_counts(notes: Sequence[Finding], paths: Paths, console: Console) -> None:
    """Count notes by file, the fullest first: they never change the exit status."""
    files: dict[str, Counter[str]] = {}
    for note in notes:
        files.setdefault(paths.shown(note.place.file), Counter())[note.code] += 1
    console.print(f'{len(notes)} notes; --verbose shows each with its line:')
    fullest = sorted(files.items(), key=lambda item: (-item[1].total(), item[0]))
    for file, codes in fullest[:MOST_FILES]:
        console.print(f'  {one_line(file)}  {_times(codes)}', soft_wrap=True)
    if len(files) > MOST_FILES:
        others = sum((codes for _, codes in fullest[MOST_FILES:]), Counter[str]())
        console.print(f'  {len(files) - MOST_FILES} more files  {_times(others)}', soft_wrap=True)


def _times(codes: Counter[str]) -> str:
    return ', '.join(f'{code} × {number}' for code, number in sorted(codes.items()))


def source_excerpt(place: Place, root: Path) -> list[str]:
    """Give the source line and a caret below it; nothing when the file cannot be read."""
    if not place.line:
        return []
    try:
        text = read_regular(root / place.file, MOST_BYTES).decode(errors='replace')
    except (OSError, ValueError):
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
