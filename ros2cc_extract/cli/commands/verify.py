"""``ros2cc-extract verify``: the verdict table, and the runs behind the verdicts."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import (
    add_dask_argument,
    add_search_arguments,
    add_unit_arguments,
    options_of,
    policy_of,
)
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_ERROR, EXIT_UNDECIDED
from ros2cc_extract.pipeline.progress import search_progress

if TYPE_CHECKING:
    from ros2cc_extract.checker.api import Query
    from ros2cc_extract.spec.close import ClosedSpec
    from ros2cc_extract.verify.results.results import QueryResult, Verification
    from ros2cc_extract.verify.search.known_answers import Shelf
    from ros2cc_extract.verify.search.options import OnProgress, Options

MODEL_SUFFIX = '.xml'


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'path',
        type=Path,
        metavar='SPEC|MODEL.xml',
        help='a YAML specification (- for standard input), a UPPAAL model, or Python source',
    )
    parser.add_argument(
        'queries',
        nargs='?',
        type=Path,
        metavar='QUERIES.q',
        help="ask these queries instead of the model's own; a specification gets its plain text",
    )
    parser.add_argument(
        '--query',
        action='append',
        default=[],
        metavar='FORMULA',
        help="ask this query instead of the model's own, as `A[] not deadlock`; may be repeated",
    )
    parser.add_argument(
        '--replay',
        type=Path,
        metavar='RUN',
        help='print a run of this model that UPPAAL saved (.xtr, or the XML or text of verifyta)',
    )
    parser.add_argument(
        '--trace',
        action='store_true',
        help='also show the witnesses of satisfied queries, and what changes in each step',
    )
    parser.add_argument('--output-format', choices=['text', 'json'], default='text')
    parser.add_argument(
        '--trace-format',
        choices=['text', 'json', 'mermaid', 'perfetto', 'uppaal', 'xtr'],
        default='text',
        help="format of the runs in -o; uppaal: the XML of verifyta -X, xtr: UPPAAL's simulator",
    )
    parser.add_argument(
        '-o', '--output', type=Path, metavar='DIR', help='folder for one trace file per run'
    )
    add_unit_arguments(parser, ranges=True)
    add_search_arguments(parser, seconds=None, ranges=True)
    add_dask_argument(parser, 'the points of a sweep')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    if len(args.threads or ()) > 1 or len(args.max_cycle) > 1:
        from ros2cc_extract.cli.shared.sweeps import run_sweeps

        _refuse_with_ranges(args)
        return run_sweeps(args, stdout, stderr)
    if args.dask is not None:
        from ros2cc_extract.errors import InputError

        what = 'only the points of a sweep are independent jobs'
        raise InputError(what, None, 'give a range of threads or of arrivals with --dask')
    if args.replay is not None:
        return _replay(args, stdout, stderr)
    from ros2cc_extract.verify.results.results import with_fewer_runs

    verifications = [with_fewer_runs(verified) for verified in _verifications(args, stderr)]
    if args.output is not None:
        _write_traces(verifications, args, stderr)
    if args.output_format == 'json':
        _print_json(verifications, stdout)
    else:
        _print_text(verifications, args, stdout)
    for verification in verifications:
        if verification.defect:
            described = f'{verification.model} is not verified: {verification.defect}'
            print(f'{described}; ROS2CC_TRACEBACK=1 shows where', file=stderr)
    if any(verification.defect for verification in verifications):
        return EXIT_ERROR
    undecided = any(verification.is_undecided for verification in verifications)
    return EXIT_UNDECIDED if undecided else EXIT_CLEAN


def _refuse_with_ranges(args: argparse.Namespace) -> None:
    from ros2cc_extract.errors import InputError

    if args.query or args.queries or args.replay:
        what = 'a sweep asks the queries of each model and shows no saved run'
        raise InputError(what, None, 'give one number of threads and of arrivals')


def _verifications(args: argparse.Namespace, stderr: TextIO) -> Iterator[Verification]:
    from ros2cc_extract.verify.given_queries import ask_unit, verify_model
    from ros2cc_extract.verify.search.known_answers import Shelf

    options, queries = options_of(args), _queries(args)
    if args.path.suffix == MODEL_SUFFIX:
        with search_progress(stderr, args.path.name) as progress:
            yield verify_model(args.path, queries, options, progress)
        return
    shelf = Shelf()
    for unit in _units(args, stderr):
        for closed, suffix in _under_releases(unit, options):
            with search_progress(stderr, f'{closed.spec.name}{suffix}') as progress:
                if queries:
                    verified = ask_unit(closed, queries, options, progress)
                else:
                    verified = _verified(closed, options, progress, shelf)
            yield replace(verified, model=f'{verified.model}{suffix}')


def _under_releases(closed: ClosedSpec, options: Options) -> Iterator[tuple[ClosedSpec, str]]:
    """The unit for each group of supported releases under which it behaves alike."""
    from ros2cc_extract.generator.releases import differing
    from ros2cc_extract.spec.releases.settings import settings, where

    rows = differing(closed.spec, options.profile)
    alike = [setting for setting in settings(rows) if setting.releases]
    if len(alike) == 1:
        yield closed, ''
        return
    for setting in alike:
        described = f'rclpy is that of {where(setting.releases, rows)}'
        spec = replace(closed.spec, rclpy=setting.release)
        assumptions = (*closed.assumptions, described)
        yield replace(closed, spec=spec, assumptions=assumptions), f'@{setting.release}'


def _verified(
    closed: ClosedSpec, options: Options, progress: OnProgress | None, shelf: Shelf
) -> Verification:
    """Verify one unit; an error of its model is reported beside the other units."""
    from ros2cc_extract.verify.undecided import failed_unit, is_defect
    from ros2cc_extract.verify.unit import verify_unit

    try:
        return verify_unit(closed, options, progress, shelf)
    except Exception as error:
        if not is_defect(error):
            raise
        return failed_unit(closed, options, error)


def _queries(args: argparse.Namespace) -> list[Query]:
    from ros2cc_extract.checker.api import Query
    from ros2cc_extract.source_locations import Place
    from ros2cc_extract.verify.given_queries import load_queries

    given = [Query(formula, '', Place('--query')) for formula in args.query]
    return [*(load_queries(args.queries) if args.queries else ()), *given]


def _units(args: argparse.Namespace, stderr: TextIO) -> Iterator[ClosedSpec]:
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.pipeline.sources import load_units
    from ros2cc_extract.spec.close import close

    units = load_units(args.path, stderr, lists_builtin=args.builtin)
    closed = [close(unit, policy_of(args)) for unit in units]
    report_releases((each.spec.rclpy for each in closed), stderr)
    yield from closed


def _replay(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.report.text.style import console_for
    from ros2cc_extract.report.text.verdicts import print_run
    from ros2cc_extract.verify.given_traces import describe_model_run, describe_unit_run

    if args.path.suffix == MODEL_SUFFIX:
        described = [describe_model_run(args.path, args.replay)]
    else:
        described = [
            describe_unit_run(u, args.replay, options_of(args)) for u in _units(args, stderr)
        ]
    for evidence in described:
        print_run(evidence, console_for(stdout), changes=args.trace)
    return EXIT_CLEAN


def _print_json(verifications: list[Verification], stdout: TextIO) -> None:
    from ros2cc_extract.report.machine.json_report import to_text, verification_data

    data = [verification_data(verification) for verification in verifications]
    stdout.write(to_text(data[0] if len(data) == 1 else data))


def _print_text(
    verifications: list[Verification], args: argparse.Namespace, stdout: TextIO
) -> None:
    from ros2cc_extract.report.text.style import console_for
    from ros2cc_extract.report.text.verdicts import print_evidence, print_table
    from ros2cc_extract.text_escaping import printable

    console = console_for(stdout)
    for verification in map(printable, verifications):
        console.print(f'model {verification.model}', style='bold')
        print_table(verification, console, details=True)
        print_evidence(_shown(verification, args.trace), console, changes=args.trace)


def _write_traces(
    verifications: list[Verification], args: argparse.Namespace, stderr: TextIO
) -> None:
    from ros2cc_extract.cli.shared.output import write_atomically
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
