"""``ros2cc-extract PATH…``: the whole job, from the source to verdicts and findings."""

from __future__ import annotations

import argparse
import os
import shlex
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import (
    add_dask_argument,
    add_launch_paths,
    add_node_arguments,
    add_search_arguments,
    add_unit_arguments,
    number_of_seconds,
    options_of,
    policy_of,
    pool_of,
)
from ros2cc_extract.cli.shared.exit_status import (
    EXIT_CLEAN,
    EXIT_ERROR,
    EXIT_FINDINGS,
    EXIT_UNDECIDED,
)
from ros2cc_extract.cli.shared.termination import Termination, termination_as_interrupt

if TYPE_CHECKING:
    from ros2cc_extract.pipeline.check import Job, Outcome
    from ros2cc_extract.pipeline.config import Config
    from ros2cc_extract.pipeline.shards import Shard
    from ros2cc_extract.report.shared.checked import Checked

DEFAULT_SECONDS = 20.0
DEFAULT_MAX_SECONDS = 120.0
FORMATS = ['text', 'json', 'sarif', 'junit', 'github', 'html', 'mermaid']


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_launch_paths(parser)
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        metavar='DIR',
        help='write specification, model and queries to DIR',
    )
    parser.add_argument(
        '--strict',
        action='store_true',
        help='exit with status 3 if a fact is unresolved or a wait undecided',
    )
    parser.add_argument('--output-format', choices=FORMATS, default='text')
    how_much = parser.add_mutually_exclusive_group()
    how_much.add_argument(
        '-q',
        '--quiet',
        action='store_true',
        help='text: one line for each finding, and the last line',
    )
    how_much.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='text: every note with its line, complete runs, and all units with their groups',
    )
    parser.add_argument(
        '--verdicts',
        action='store_true',
        help='text, html: also show the queries and verdicts of each unit, as verify does',
    )
    parser.add_argument(
        '--assume',
        action='append',
        default=[],
        metavar='FACT',
        help='assume a fact: threads=4, executor=MultiThreadedExecutor, group.NAME=REENTRANT',
    )
    _add_what_is_accepted(parser)
    add_node_arguments(parser, confirms=True)
    add_unit_arguments(parser)
    add_search_arguments(parser, seconds=DEFAULT_SECONDS)
    parser.add_argument(
        '--max-seconds',
        type=number_of_seconds,
        default=DEFAULT_MAX_SECONDS,
        metavar='S',
        help='stop after S seconds in total (default %(default)g); the rest is undecided',
    )


def _add_what_is_accepted(parser: argparse.ArgumentParser) -> None:
    only_new = parser.add_argument_group('only new findings')
    only_new.add_argument(
        '--baseline', type=Path, metavar='FILE', help='accept the findings in FILE'
    )
    only_new.add_argument(
        '--write-baseline',
        type=Path,
        metavar='FILE',
        help='write all findings to FILE, to be accepted',
    )
    only_new.add_argument(
        '--diff-base', metavar='REV', help='accept findings that were already in git revision REV'
    )
    add_dask_argument(parser, 'units')
    _add_shards(parser)


def _add_shards(parser: argparse.ArgumentParser) -> None:
    parts = parser.add_argument_group('in several jobs').add_mutually_exclusive_group()
    parts.add_argument(
        '--shard',
        type=_shard,
        metavar='I/N',
        help='verify and report the I-th of N parts of the units only; with --output-format json',
    )
    parts.add_argument(
        '--from-shards',
        nargs='+',
        type=Path,
        metavar='JSON',
        help='verify nothing: report what the shards of all units have written',
    )


def _shard(text: str) -> Shard:
    from ros2cc_extract.pipeline.shards import Shard

    number, slash, of = text.partition('/')
    if not (slash and number.isdecimal() and of.isdecimal() and 1 <= int(number) <= int(of)):
        raise argparse.ArgumentTypeError(f'{text!r} is no shard; write 1/4')
    return Shard(int(number), int(of))


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.pipeline.check import check_paths
    from ros2cc_extract.pipeline.config import load_config
    from ros2cc_extract.pipeline.sources import has_unread

    _refuse_to_judge_parts(args)
    release = _release_to_confirm_on(args)
    args.paths, arguments = _divided(args.paths)
    config = load_config(min(args.paths, key=Path.absolute))
    job = replace(_job(args, config), arguments=arguments)
    termination, begun = Termination(), time.monotonic()
    try:
        with termination_as_interrupt(termination):
            known = _known(args, config, job, stderr)
            job = replace(job, known=known, spent_s=time.monotonic() - begun)
            outcome = check_paths(job, stderr)
    except KeyboardInterrupt:  # before there was anything to report
        if not termination.is_asked:
            raise
        print('interrupted', file=stderr)
        return termination.status
    if args.confirm and not outcome.interrupted:
        from ros2cc_extract.cli.shared.on_node import with_outcomes

        outcome = replace(outcome, findings=with_outcomes(outcome, args, release, stderr))
    report_releases((job.assumptions.rclpy, *(unit.rclpy for unit in outcome.units)), stderr)
    if outcome.interrupted and args.write_baseline is not None:
        raise KeyboardInterrupt  # a baseline accepts all of today, or nothing
    if args.output is not None:
        _keep(args, outcome, stderr)
    if args.write_baseline is not None:
        _write_baseline(args.write_baseline, outcome, job, stderr)
        return EXIT_CLEAN
    _print(args, outcome, job, stdout, time.monotonic() - begun)
    if outcome.interrupted:
        print('interrupted: what was not verified yet is undecided', file=stderr)
        return termination.status
    if not outcome.units and job.sees_all and not has_unread(outcome.extraction.diagnostics):
        return _report_nothing_judged(args, outcome, stderr)
    return _status(args, outcome)


def _release_to_confirm_on(args: argparse.Namespace) -> str | None:
    """The one that is there; what is judged is how nodes behave on it."""
    if not args.confirm:
        return None
    from ros2cc_extract.cli.shared.on_node import interpreter_of
    from ros2cc_extract.confirm.processes import release_of

    release = release_of(interpreter_of(args))
    args.rclpy = args.rclpy or release
    return release


def _refuse_to_judge_parts(args: argparse.Namespace) -> None:
    """
    One part of the units says nothing of the whole.

    :raises InputError: when it is asked to.
    """
    from ros2cc_extract.errors import InputError

    if args.shard is not None and args.write_baseline is not None:
        what = 'a shard does not find all there is to accept'
        raise InputError(what, None, 'write the baseline with --from-shards')
    if args.shard is not None and args.output_format != 'json':
        what = 'a shard is no check of its own'
        raise InputError(what, None, 'add --output-format json, and report with --from-shards')


def _job(args: argparse.Namespace, config: Config) -> Job:
    from ros2cc_extract.pipeline.check import Job
    from ros2cc_extract.pipeline.config import assumptions_of
    from ros2cc_extract.pipeline.shards import read_shards

    options, assumptions = options_of(args), assumptions_of(config, args.assume)
    if config.timeout is not None and args.timeout == DEFAULT_SECONDS:
        options = replace(options, limits=replace(options.limits, seconds=config.timeout))
    return Job(
        paths=args.paths,
        config=config,
        policy=policy_of(args),
        options=options,
        assumptions=replace(assumptions, rclpy=args.rclpy or assumptions.rclpy),
        root=config.root.resolve(),
        cached=not args.no_cache,
        shows_verdicts=args.verdicts or args.output_format == 'json' or bool(args.from_shards),
        keeps_runs=_shows_all_runs(args) or bool(args.from_shards),
        max_seconds=args.max_seconds,
        pool=pool_of(args),
        shard=args.shard,
        known_units=read_shards(args.from_shards) if args.from_shards else None,
    )


def _shows_all_runs(args: argparse.Namespace) -> bool:
    """Whether the run behind every verdict is wanted."""
    form = str(args.output_format)
    return form == 'json' or (form == 'html' and bool(args.verdicts))


def _known(args: argparse.Namespace, config: Config, job: Job, stderr: TextIO) -> frozenset[str]:
    """Collect the fingerprints that are accepted already."""
    from ros2cc_extract.findings.filters.baseline import read_baseline
    from ros2cc_extract.pipeline.sources import read_input

    known: frozenset[str] = frozenset()
    baseline = args.baseline or config.baseline
    if baseline is not None and args.write_baseline is None:
        known = read_baseline(read_input(baseline), str(baseline))
    if args.diff_base is not None:
        from ros2cc_extract.pipeline.base_revision import fingerprints_at

        known |= fingerprints_at(args.diff_base, job, stderr)
    return known


def _keep(args: argparse.Namespace, outcome: Outcome, stderr: TextIO) -> None:
    from ros2cc_extract.cli.commands.model import model_files, unit_folders
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.generator.build import render
    from ros2cc_extract.spec.yaml.yaml_io import write_specs

    options = options_of(args)
    folders = unit_folders([unit.name for unit in outcome.units], args.output)
    for unit, closed, folder in zip(outcome.units, outcome.closed, folders, strict=True):
        write_atomically(folder / f'{unit.name}.spec.yaml', write_specs([unit]))
        rendered = render(
            closed, profile=options.profile, text=options.text, max_cycle=options.max_cycle
        )
        for name, text in model_files(rendered).items():
            write_atomically(folder / name, text)
    print(f'wrote {len(outcome.units)} units to {args.output}', file=stderr)


def _write_baseline(path: Path, outcome: Outcome, job: Job, stderr: TextIO) -> None:
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.findings.filters.baseline import write_baseline

    write_atomically(path, write_baseline(outcome.findings, job.root.as_posix()))
    print(f'wrote {path}; use it with --baseline {path}', file=stderr)


def _print(
    args: argparse.Namespace, outcome: Outcome, job: Job, stdout: TextIO, seconds: float
) -> None:
    from ros2cc_extract.cli.shared.checked import checked_of

    form = args.output_format
    checked = checked_of(outcome, job, with_verdicts=args.verdicts)
    if form == 'text':
        _print_text(args, checked, stdout, seconds)
        return
    from ros2cc_extract.report.formats import write

    stdout.write(write(checked, form))
    if form == 'github':
        _append_step_summary(checked)


def _print_text(
    args: argparse.Namespace, checked: Checked, stdout: TextIO, seconds: float
) -> None:
    from ros2cc_extract.report.text.check import Presentation, print_check
    from ros2cc_extract.report.text.findings import Detail
    from ros2cc_extract.report.text.style import console_for

    detail = Detail.QUIET if args.quiet else Detail.VERBOSE if args.verbose else Detail.USUAL
    how = Presentation(
        detail=detail,
        paths=shlex.join(str(path) for path in args.paths),
        seconds=seconds,
    )
    print_check(checked, console_for(stdout), how)


def _report_nothing_judged(args: argparse.Namespace, outcome: Outcome, stderr: TextIO) -> int:
    """Zero problems of nothing may read as safe; of a system that is undecided."""
    status = _status(args, outcome)
    if outcome.system is None:
        print('nothing to check: no rclpy node with a callback found', file=stderr)
        return status
    number = len(outcome.system.processes)
    reason = f'none of {number} processes has a known callback'
    reason = reason if number else 'the launch file starts no known process'
    print(f'nothing to check: {reason}', file=stderr)
    return EXIT_UNDECIDED if status == EXIT_CLEAN else status


def _divided(words: Sequence[str]) -> tuple[list[Path], dict[str, str]]:
    """
    Paths, and arguments of launch files among them.

    :raises InputError: when there is no path.
    """
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.pipeline.system_sources import divided

    paths, arguments = divided(words)
    if not paths:
        raise InputError('no path given', None, 'name a Python file, a launch file or a directory')
    return paths, arguments


def _append_step_summary(checked: Checked) -> None:
    """GitHub names the file in which a step's summary is kept."""
    from ros2cc_extract.report.machine.github import step_summary

    name = os.environ.get('GITHUB_STEP_SUMMARY')
    if name:
        with Path(name).open('a', encoding='utf-8') as stream:
            stream.write(step_summary(checked.findings, checked.summary, root=checked.root))


def _status(args: argparse.Namespace, outcome: Outcome) -> int:
    from ros2cc_extract.pipeline.sources import has_barred, nothing_read

    if nothing_read(args.paths, outcome.extraction):
        return EXIT_ERROR
    if outcome.has_findings:
        return EXIT_FINDINGS
    if args.strict and has_barred(outcome.extraction.diagnostics):
        return EXIT_ERROR
    unresolved = args.strict and _is_unresolved(outcome)
    return EXIT_UNDECIDED if unresolved or outcome.is_undecided else EXIT_CLEAN


def _is_unresolved(outcome: Outcome) -> bool:
    """Whether a unit has an open fact or wait, or was left out, or a file was not read."""
    from ros2cc_extract.pipeline.sources import NOT_FOLLOWED, has_unread

    noticed = outcome.extraction.diagnostics
    of_units = any(unit.unresolved for unit in outcome.units) or bool(outcome.undecided_waits)
    return of_units or has_unread(noticed) or any(d.slug == NOT_FOLLOWED for d in noticed)
