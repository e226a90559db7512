"""A whole check for people: each unit with its verdicts, then the findings, then one line."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.console import Console
from rich.padding import Padding

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import CODE as UNDECIDED_WAIT
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.text.confidence import confidence_lines
from ros2cc_extract.report.text.findings import print_findings, print_in_lines
from ros2cc_extract.report.text.overview import print_overview
from ros2cc_extract.report.text.spec import print_spec
from ros2cc_extract.report.text.style import table
from ros2cc_extract.report.text.verdicts import print_digest, print_evidence, print_table
from ros2cc_extract.shown import one_line, printable
from ros2cc_extract.spec.confidence import confidence_in
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

MOST_TABLES = 3
"""More units than this are shown as one row each."""
MOST_NOTES = 10
"""More notes than this are counted by file."""
MOST_FILES = 10
"""Of more files than this the notes are counted together."""
LONGEST_TABLE = 40
FINDINGS = ('errors', 'warnings', 'notes', 'undecided_waits', 'accepted')
SIZES = ('files', 'units', 'callbacks')
VERDICTS = ('satisfied', 'not_satisfied', 'undecided')
OF_NO_INTEREST = {'group_closed_while_running', 'group_always_open'}
"""Families whose runs show no more than that a callback can start."""
OF_ANOTHER_EXECUTOR = ('paper', 'starvation')
"""Runs in which data vanishes that rclpy keeps: beside a finding they lead astray."""


def print_check(
    verified: Sequence[tuple[Spec, Verification]],
    findings: Sequence[Finding],
    summary: Mapping[str, int],
    console: Console,
    *,
    tables: bool = False,
) -> None:
    """
    Print everything; the findings come last, where a terminal shows them.

    :param tables: every unit's verdicts, however many units there are.
    """
    if len(verified) > MOST_TABLES and not tables:
        print_overview(verified, findings, console)
    else:
        for unit, verification in verified:
            print_spec(printable(unit), console)
            console.print()
            _print_verification(verification, console)
            console.print()
    open_waits = [finding for finding in findings if finding.code == UNDECIDED_WAIT]
    findings = [finding for finding in findings if finding not in open_waits]
    notes = [finding for finding in findings if finding.severity is Severity.NOTE]
    brief = len(notes) > MOST_NOTES and not tables
    told = [finding for finding in findings if finding not in notes] if brief else findings
    print_findings(told, Path.cwd(), console)
    if brief:
        _print_notes(notes, console)
    print_in_lines(open_waits, console)
    for line in confidence_lines(confidence_in(unit for unit, _ in verified), 0):
        console.print(one_line(line))
    console.print(_totals(summary), soft_wrap=True)


def _totals(summary: Mapping[str, int]) -> str:
    """What decides the exit status stands first."""
    kinds = [kind for kind in FINDINGS if summary[kind] or kind != 'undecided_waits']
    found = f'{_counts(summary, kinds)} in {_counts(summary, SIZES)}'
    return f'{found}; verdicts: {_counts(summary, VERDICTS)}' if summary['units'] else found


def _counts(summary: Mapping[str, int], kinds: Sequence[str]) -> str:
    return ', '.join(counted(summary[what], what) for what in kinds)


def _print_notes(notes: Sequence[Finding], console: Console) -> None:
    """Count notes by file, the fullest first: they never change the exit status."""
    files: dict[str, Counter[str]] = {}
    for note in notes:
        files.setdefault(note.place.file, Counter())[note.code] += 1
    console.print(f'{len(notes)} notes, each with its line by --tables:')
    rows = table('', '')
    rows.show_header = False
    fullest = sorted(files.items(), key=lambda item: (-item[1].total(), item[0]))
    for file, codes in fullest[:MOST_FILES]:
        rows.add_row(one_line(file), _times(codes))
    if len(files) > MOST_FILES:
        others = sum((codes for _, codes in fullest[MOST_FILES:]), Counter[str]())
        rows.add_row(f'{len(files) - MOST_FILES} more files', _times(others))
    console.print(Padding(rows, (0, 0, 0, 2)))


def _times(codes: Counter[str]) -> str:
    return ', '.join(f'{code} × {number}' for code, number in sorted(codes.items()))


def _print_verification(verification: Verification, console: Console) -> None:
    if len(verification.results) <= LONGEST_TABLE:
        print_table(verification, console, details=False)
    else:
        print_digest(verification, console)
    shown, left_out = _first_of_each_family(verification)
    print_evidence(shown, console)
    if left_out:
        console.print(f'  {counted(left_out, "more runs")}: ros2cc-extract verify shows them')


def _first_of_each_family(
    verification: Verification,
) -> tuple[list[tuple[int, QueryResult]], int]:
    shown: dict[str | None, tuple[int, QueryResult]] = {}
    runs = 0
    for number, result in enumerate(verification.results, start=1):
        told = result.run is not None and result.family not in OF_NO_INTEREST
        if result.verdict is Verdict.NOT_SATISFIED and told:
            runs += 1
            if (verification.profile, result.family) != OF_ANOTHER_EXECUTOR:
                shown.setdefault(result.family, (number, result))
    return list(shown.values()), runs - len(shown)
