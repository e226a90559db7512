"""``ros2cc-extract PATH…``: the whole job, from the source to verdicts and findings."""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.arguments import (
    add_paths,
    add_search_arguments,
    add_unit_arguments,
    options_of,
    policy_of,
)
from ros2cc_extract.cli.main import EXIT_CLEAN, EXIT_ERROR, EXIT_FINDINGS, EXIT_UNDECIDED
from ros2cc_extract.cli.progress import search_progress
from ros2cc_extract.cli.sources import has_errors, scan_sources
from ros2cc_extract.diagnostics import Severity

if TYPE_CHECKING:
    from rich.console import Console

    from ros2cc_extract.extract.extraction import Extraction
    from ros2cc_extract.findings.model import Finding
    from ros2cc_extract.report.formats import Checked
    from ros2cc_extract.spec.close import ClosedSpec
    from ros2cc_extract.verify import QueryResult, Verification

DEFAULT_SECONDS = 20.0
LONGEST_TABLE = 40
OF_NO_INTEREST = {'group_closed_while_running', 'group_always_open'}
"""Families whose runs show no more than that a callback can start."""
FORMATS = ['text', 'json', 'sarif', 'junit', 'github', 'html', 'mermaid']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_paths(parser)
    parser.add_argument(
        '-o', '--output', type=Path, metavar='DIR', help='keep specification, model and queries'
    )
    parser.add_argument('--strict', action='store_true', help='exit 3 when a fact is unresolved')
    parser.add_argument('--output-format', choices=FORMATS, default='text')
    add_unit_arguments(parser)
    add_search_arguments(parser, seconds=DEFAULT_SECONDS)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.findings.collect import findings_of
    from ros2cc_extract.spec.close import close

    extraction = scan_sources(args.paths, stderr)
    closed_units = [close(unit, policy_of(args)) for unit in extraction.units]
    if args.output is not None:
        _keep(args, extraction, closed_units, stderr)
    verifications = _verify(args, closed_units, stderr)
    findings = findings_of(extraction.units, extraction.diagnostics, verifications)
    if args.output_format == 'text':
        _print_text(extraction, verifications, findings, stdout)
    else:
        _print_report(args.output_format, extraction, verifications, findings, stdout)
    return _status(args, extraction, verifications, findings)


def _keep(
    args: argparse.Namespace,
    extraction: Extraction,
    closed_units: Sequence[ClosedSpec],
    stderr: TextIO,
) -> None:
    from ros2cc_extract.cli.model import model_files, unit_folders
    from ros2cc_extract.cli.output import write_atomically
    from ros2cc_extract.generator.build import render
    from ros2cc_extract.spec.yaml_io import write_specs

    options = options_of(args)
    folders = unit_folders([unit.name for unit in extraction.units], args.output)
    for unit, closed, folder in zip(extraction.units, closed_units, folders, strict=True):
        write_atomically(folder / f'{unit.name}.spec.yaml', write_specs([unit]))
        rendered = render(
            closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
        )
        for name, text in model_files(rendered).items():
            write_atomically(folder / name, text)
    print(f'kept {len(closed_units)} units in {args.output}', file=stderr)


def _verify(
    args: argparse.Namespace, closed_units: Sequence[ClosedSpec], stderr: TextIO
) -> list[Verification]:
    from ros2cc_extract.verify import verify_unit

    options = options_of(args)
    verifications = []
    for closed in closed_units:
        with search_progress(stderr, closed.spec.name) as progress:
            verifications.append(verify_unit(closed, options, progress))
    return verifications


def _print_report(
    format: str,
    extraction: Extraction,
    verifications: Sequence[Verification],
    findings: Sequence[Finding],
    stdout: TextIO,
) -> None:
    from ros2cc_extract.report.formats import Checked, write

    checked = Checked(
        units=extraction.units,
        verifications=verifications,
        findings=findings,
        summary=_summary(extraction, verifications, findings),
        files=extraction.files_seen,
        sources=_sources(extraction.files_seen),
        root=Path.cwd().as_posix(),
        package=Path.cwd().name,
    )
    stdout.write(write(checked, format))
    if format == 'github':
        _append_step_summary(checked)


def _append_step_summary(checked: Checked) -> None:
    """GitHub names the file in which a step's summary is kept."""
    from ros2cc_extract.report.github import step_summary

    name = os.environ.get('GITHUB_STEP_SUMMARY')
    if name:
        with Path(name).open('a', encoding='utf-8') as stream:
            stream.write(step_summary(checked.findings, checked.summary, root=checked.root))


def _sources(files: Sequence[str]) -> dict[str, str]:
    texts = {}
    for file in files:
        try:
            texts[file] = Path(file).read_text(encoding='utf-8', errors='replace')
        except OSError:
            continue
    return texts


def _print_text(
    extraction: Extraction,
    verifications: Sequence[Verification],
    findings: Sequence[Finding],
    stdout: TextIO,
) -> None:
    from ros2cc_extract.report.findings_text import print_findings
    from ros2cc_extract.report.spec_text import print_spec
    from ros2cc_extract.report.style import console_for

    console = console_for(stdout)
    for unit, verification in zip(extraction.units, verifications, strict=True):
        print_spec(unit, console)
        console.print()
        _print_verification(verification, console)
        console.print()
    print_findings(findings, Path.cwd(), console)
    counts = _summary(extraction, verifications, findings)
    console.print(', '.join(_counted(number, what) for what, number in counts.items()))


def _print_verification(verification: Verification, console: Console) -> None:
    from ros2cc_extract.report.verdict_text import print_digest, print_evidence, print_table

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
    from ros2cc_extract.checker.api import Verdict

    shown: dict[str | None, tuple[int, QueryResult]] = {}
    runs = 0
    for number, result in enumerate(verification.results, start=1):
        told = result.evidence is not None and result.family not in OF_NO_INTEREST
        if result.verdict is Verdict.NOT_SATISFIED and told:
            runs += 1
            shown.setdefault(result.family, (number, result))
    return list(shown.values()), runs - len(shown)


def _counted(number: int, what: str) -> str:
    one = what[:-1] if number == 1 and what.endswith('s') else what
    return f'{number} {one.replace("_", " ")}'


def _summary(
    extraction: Extraction, verifications: Sequence[Verification], findings: Sequence[Finding]
) -> dict[str, int]:
    verdicts = Counter(
        result.verdict.value for verification in verifications for result in verification.results
    )
    severities = Counter(finding.severity for finding in findings)
    return {
        'files': len(extraction.files_seen),
        'units': len(extraction.units),
        'callbacks': sum(len(unit.callbacks) for unit in extraction.units),
        'satisfied': verdicts['satisfied'],
        'not_satisfied': verdicts['not satisfied'],
        'undecided': verdicts['undecided'],
        'errors': severities[Severity.ERROR],
        'warnings': severities[Severity.WARNING],
        'notes': severities[Severity.NOTE],
    }


def _status(
    args: argparse.Namespace,
    extraction: Extraction,
    verifications: Sequence[Verification],
    findings: Sequence[Finding],
) -> int:
    if has_errors(extraction.diagnostics):
        return EXIT_ERROR
    if any(finding.severity is not Severity.NOTE for finding in findings):
        return EXIT_FINDINGS
    unresolved = args.strict and any(unit.unresolved for unit in extraction.units)
    undecided = any(verification.is_undecided for verification in verifications)
    return EXIT_UNDECIDED if unresolved or undecided else EXIT_CLEAN
