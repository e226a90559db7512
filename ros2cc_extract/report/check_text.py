"""A whole check for people: each unit with its verdicts, then the findings, then one line."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from rich.console import Console

from ros2cc_extract.findings.model import Finding
from ros2cc_extract.report.counts import counted
from ros2cc_extract.report.findings_text import print_findings
from ros2cc_extract.report.spec_text import print_spec
from ros2cc_extract.report.verdict_text import print_digest, print_evidence, print_table
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify import QueryResult, Verdict, Verification

LONGEST_TABLE = 40
OF_NO_INTEREST = {'group_closed_while_running', 'group_always_open'}
"""Families whose runs show no more than that a callback can start."""


def print_check(
    verified: Sequence[tuple[Spec, Verification]],
    findings: Sequence[Finding],
    summary: Mapping[str, int],
    console: Console,
) -> None:
    """Print everything; the findings come last, where a terminal shows them."""
    for unit, verification in verified:
        print_spec(unit, console)
        console.print()
        _print_verification(verification, console)
        console.print()
    print_findings(findings, Path.cwd(), console)
    console.print(', '.join(counted(number, what) for what, number in summary.items()))


def _print_verification(verification: Verification, console: Console) -> None:
    if len(verification.results) <= LONGEST_TABLE:
        print_table(verification, console, details=False)
    else:
        print_digest(verification, console)
    shown, left_out = _first_of_each_family(verification)
    print_evidence(shown, console)
    if left_out:
        console.print(f'  {left_out} more runs of these kinds: ros2cc-extract verify shows them')


def _first_of_each_family(
    verification: Verification,
) -> tuple[list[tuple[int, QueryResult]], int]:
    shown: dict[str | None, tuple[int, QueryResult]] = {}
    runs = 0
    for number, result in enumerate(verification.results, start=1):
        told = result.run is not None and result.family not in OF_NO_INTEREST
        if result.verdict is Verdict.NOT_SATISFIED and told:
            runs += 1
            shown.setdefault(result.family, (number, result))
    return list(shown.values()), runs - len(shown)
