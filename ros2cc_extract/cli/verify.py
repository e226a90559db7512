"""``ros2cc-extract verify``: the verdict table, and the runs behind the verdicts."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.arguments import (
    add_search_arguments,
    add_unit_arguments,
    options_of,
    policy_of,
)
from ros2cc_extract.cli.main import EXIT_CLEAN, EXIT_UNDECIDED
from ros2cc_extract.cli.progress import search_progress

if TYPE_CHECKING:
    from ros2cc_extract.verify import QueryResult, Verification

MODEL_SUFFIX = '.xml'


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'path',
        type=Path,
        metavar='SPEC|MODEL.xml',
        help='a YAML specification, a UPPAAL model, or Python source',
    )
    parser.add_argument(
        'queries', nargs='?', type=Path, metavar='QUERIES.q', help='queries of a UPPAAL model'
    )
    parser.add_argument(
        '--trace',
        action='store_true',
        help='show the witnesses of satisfied queries too, and what changes in each step',
    )
    parser.add_argument('--output-format', choices=['text', 'json'], default='text')
    parser.add_argument(
        '--trace-format',
        choices=['text', 'json', 'mermaid', 'perfetto'],
        default='text',
        help='how runs are written; mermaid and perfetto need -o',
    )
    parser.add_argument(
        '-o', '--output', type=Path, metavar='DIR', help='folder for one trace file per run'
    )
    add_unit_arguments(parser, ranges=True)
    add_search_arguments(parser, seconds=None, ranges=True)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    if len(args.threads or ()) > 1 or len(args.max_cycle) > 1:
        from ros2cc_extract.cli.sweep import run_sweeps

        return run_sweeps(args, stdout, stderr)
    verifications = list(_verifications(args, stderr))
    if args.output is not None:
        _write_traces(verifications, args, stderr)
    if args.output_format == 'json':
        _print_json(verifications, stdout)
    else:
        _print_text(verifications, args, stdout)
    undecided = any(verification.is_undecided for verification in verifications)
    return EXIT_UNDECIDED if undecided else EXIT_CLEAN


def _verifications(args: argparse.Namespace, stderr: TextIO) -> Iterator[Verification]:
    from ros2cc_extract.verify import verify_model, verify_unit

    options = options_of(args)
    if args.path.suffix == MODEL_SUFFIX:
        with search_progress(stderr, args.path.name) as progress:
            yield verify_model(args.path, args.queries, options, progress)
        return
    from ros2cc_extract.cli.sources import load_units
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.places import Place
    from ros2cc_extract.spec.close import close

    if args.queries is not None:
        place = Place(str(args.queries))
        raise InputError('queries go with a MODEL.xml', place, 'a specification brings its own')
    for unit in load_units(args.path, stderr):
        with search_progress(stderr, unit.name) as progress:
            yield verify_unit(close(unit, policy_of(args)), options, progress)


def _print_json(verifications: list[Verification], stdout: TextIO) -> None:
    from ros2cc_extract.report.json_report import to_text, verification_data

    data = [verification_data(verification) for verification in verifications]
    stdout.write(to_text(data[0] if len(data) == 1 else data))


def _print_text(
    verifications: list[Verification], args: argparse.Namespace, stdout: TextIO
) -> None:
    from ros2cc_extract.report.style import console_for
    from ros2cc_extract.report.verdict_text import print_evidence, print_table

    console = console_for(stdout)
    for verification in verifications:
        console.print(f'model {verification.model}', style='bold')
        print_table(verification, console, details=True)
        print_evidence(_shown(verification, args.trace), console, changes=args.trace)


def _write_traces(
    verifications: list[Verification], args: argparse.Namespace, stderr: TextIO
) -> None:
    from ros2cc_extract.cli.output import write_atomically
    from ros2cc_extract.report.trace_formats import SUFFIXES, write_trace

    written = 0
    for verification in verifications:
        for number, result in _shown(verification, args.trace):
            if result.evidence is not None:
                name = f'{verification.model}_{number:03}{SUFFIXES[args.trace_format]}'
                text = write_trace(result.evidence, result.words, args.trace_format)
                write_atomically(args.output / name, text)
                written += 1
    print(f'wrote {written} traces to {args.output}', file=stderr)


def _shown(verification: Verification, witnesses: bool) -> Iterator[tuple[int, QueryResult]]:
    from ros2cc_extract.checker.api import Verdict

    for number, result in enumerate(verification.results, start=1):
        if witnesses or result.verdict is Verdict.NOT_SATISFIED:
            yield number, result
