"""A whole check for people: the findings, what was checked, what is not known, and one line."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.shared.counts import counted
from ros2cc_extract.report.shared.last_line import last_line
from ros2cc_extract.report.text.findings import Detail, print_findings
from ros2cc_extract.report.text.paths import Paths
from ros2cc_extract.report.text.spec import print_spec
from ros2cc_extract.report.text.units import print_units, unknown_lines
from ros2cc_extract.report.text.verdicts import print_digest, print_evidence, print_table
from ros2cc_extract.spec.confidence import confidence_in
from ros2cc_extract.text_escaping import one_line, printable
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

LONGEST_TABLE = 40
LONGEST_ARGUMENTS = 40
OF_NO_INTEREST = {'group_closed_while_running', 'group_always_open'}
"""Families whose runs show no more than that a callback can start."""
OF_ANOTHER_EXECUTOR = ('paper', 'starvation')
"""Runs in which data vanishes that rclpy keeps: beside a finding they lead astray."""


@dataclass(frozen=True, kw_only=True)
class Presentation:
    """
    How a check is reported.

    :param paths: what was checked, as the user wrote it.
    :param seconds: how long it took; only a terminal gets it, so that logs stay the same.
    """

    detail: Detail = Detail.USUAL
    paths: str = 'PATH'
    seconds: float | None = None


def print_check(checked: Checked, console: Console, how: Presentation) -> None:
    """Print everything, in the order in which it is read."""
    is_quiet, is_verbose = how.detail is Detail.QUIET, how.detail is Detail.VERBOSE
    print_findings(checked.findings, Paths(Path.cwd(), checked.root), console, how.detail)
    if checked.findings and checked.units and not is_quiet:
        console.print()
    if is_verbose:
        for unit in checked.units:
            print_spec(printable(unit), console)
            console.print()
    if not is_quiet:
        print_units(checked.units, checked.promises, console, all_rows=is_verbose)
    if checked.with_verdicts:
        for unit, verification in zip(checked.units, checked.verifications, strict=True):
            console.print()
            console.print(one_line(f'unit {unit.name}'), style='bold')
            _print_verification(verification, console)
        console.print()
    if not is_quiet:
        _print_unknown(checked, console, how.paths)
    console.print(_end(checked, console, how.seconds), soft_wrap=True, style='bold')


def _print_unknown(checked: Checked, console: Console, paths: str) -> None:
    summary = confidence_in(checked.units)
    assumed = sum(sum(each.assumed.values()) for each in summary.of.values())
    shown = paths if len(paths) <= LONGEST_ARGUMENTS else 'PATH'
    for line in unknown_lines(len(summary.open), assumed, one_line(shown)):
        console.print(line, soft_wrap=True)


def _end(checked: Checked, console: Console, seconds: float | None) -> str:
    line = last_line(checked.summary)
    is_timed = seconds is not None and console.file.isatty()
    return f'{line} ({seconds:.1f} s)' if is_timed else line


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
        has_run = result.run is not None and result.family not in OF_NO_INTEREST
        if result.verdict is Verdict.NOT_SATISFIED and has_run:
            runs += 1
            if (verification.profile, result.family) != OF_ANOTHER_EXECUTOR:
                shown.setdefault(result.family, (number, result))
    return list(shown.values()), runs - len(shown)
