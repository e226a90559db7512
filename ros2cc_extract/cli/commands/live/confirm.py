"""``ros2cc-extract confirm``: show findings on the running node."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import (
    add_cache_argument,
    add_node_arguments,
    number_of_seconds,
)
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS

if TYPE_CHECKING:
    from ros2cc_extract.confirm.confirming import Confirmation
    from ros2cc_extract.confirm.schedules import Schedule
    from ros2cc_extract.pipeline.check import Job

DEFAULT_SECONDS = 30.0
SECONDS_A_MODEL, MOST_SECONDS = 20.0, 120.0
"""As of `check`."""
EPILOG = """\
examples:
  ros2cc-extract confirm my_node.py
  ros2cc-extract confirm my_node.py CC101:24 --keep hang.json
  ros2cc-extract confirm --replay hang.json

Starts your program, and beside it a stimulus that sends what the program waits for from outside,
in a ROS domain of their own and on this machine only; both are killed in the end. Each finding is
confirmed, not reached (with the reason), or contradicted. Asks before it starts a program for the
first time. Exit status: 1 something is confirmed; 0 nothing is; 2 it could not be tried.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = '%(prog)s [options] (PATH [CODE[:LINE]] | --replay FILE)'
    parser.epilog = EPILOG
    parser.add_argument(
        'path', nargs='?', type=Path, metavar='PATH', help='a Python file or a directory'
    )
    parser.add_argument(
        'finding',
        nargs='?',
        metavar='CODE[:LINE]',
        help='only findings of this rule, or of this line (default: all that can be shown)',
    )
    parser.add_argument(
        '--limit',
        type=number_of_seconds,
        default=DEFAULT_SECONDS,
        metavar='S',
        help='give up after S seconds for each finding (default %(default)g)',
    )
    parser.add_argument(
        '--keep', type=Path, metavar='FILE', help='write the schedule of what was confirmed first'
    )
    parser.add_argument(
        '--replay', type=Path, metavar='FILE', help='repeat a schedule that --keep has written'
    )
    parser.add_argument('--output-format', choices=('text', 'json'), default='text')
    add_node_arguments(parser)
    add_cache_argument(parser)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.on_node import interpreter_of
    from ros2cc_extract.confirm.confirming import confirm
    from ros2cc_extract.confirm.consent import ask_to_start
    from ros2cc_extract.confirm.outcomes import Outcome
    from ros2cc_extract.confirm.processes import release_of
    from ros2cc_extract.confirm.wording import as_json, as_text, summary
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.pipeline.system_sources import names_launch_file
    from ros2cc_extract.source_locations import Place

    if (args.path is None) == (args.replay is None):
        raise InputError('one path, or --replay', None, 'as in: confirm my_node.py')
    if args.path is not None and names_launch_file(args.path):
        mend = 'name the Python file of one of its nodes'
        raise InputError('a launch file is not started', Place(str(args.path)), mend)
    python = interpreter_of(args)
    release = release_of(python)
    schedules = _schedules(args, release, stderr)
    for entry in dict.fromkeys(each.entry for each in schedules):
        ask_to_start(entry, python, stderr, yes=args.yes)
    found = []
    for schedule in schedules:
        found.append(confirm(schedule, python, args.limit, stubs=args.stub_missing))
        if args.output_format == 'text':
            stdout.write(as_text(found[-1], release))
            stdout.flush()
    stdout.write(
        as_json(found, release) if args.output_format == 'json' else summary(found) + '\n'
    )
    shown = [each for each in found if each.judgement.outcome is Outcome.CONFIRMED]
    _keep(args.keep, shown, stderr)
    return EXIT_FINDINGS if shown else EXIT_CLEAN


def _schedules(
    args: argparse.Namespace, release: str | None, stderr: TextIO
) -> Sequence[Schedule]:
    from ros2cc_extract.confirm.schedules import read_schedule

    if args.replay is not None:
        return [read_schedule(args.replay)]
    return _schedules_of_findings(args, release, stderr)


def _schedules_of_findings(
    args: argparse.Namespace, release: str | None, stderr: TextIO
) -> Sequence[Schedule]:
    """
    Check the path as it behaves on the release that is there, and make a schedule of each finding.

    :raises InputError: when the finding that is asked for is not there.
    """
    from ros2cc_extract.confirm.schedules import CONFIRMABLE, can_be_tried, schedule_of
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.pipeline.check import check_paths
    from ros2cc_extract.source_locations import Place

    outcome = check_paths(job(args.path, release, cached=not args.no_cache), stderr)
    code, _, line = (args.finding or '').partition(':')
    asked = [
        each
        for each in outcome.findings
        if each.code == (code or each.code) and line in ('', str(each.place.line))
    ]
    if args.finding and not asked:
        there = sorted({f'{each.code}:{each.place.line}' for each in outcome.findings})
        mend = f'there are: {", ".join(there)}' if there else 'there is none'
        raise InputError(f'has no finding {args.finding}', Place(str(args.path)), mend)
    found = [each for each in asked if can_be_tried(each)]
    left = sorted({each.code for each in asked if not can_be_tried(each)})
    if left and args.finding:
        known = ', '.join(sorted(CONFIRMABLE))
        print(f'ros2cc-extract: not tried: {", ".join(left)}; tried are {known}', file=stderr)
    return [schedule_of(each, outcome.units) for each in found]


def job(path: Path, release: str | None, *, cached: bool) -> Job:
    """The check with its usual limits, under the release that runs the node."""
    from ros2cc_extract.checker.engines.limits import Limits
    from ros2cc_extract.pipeline.check import Job
    from ros2cc_extract.pipeline.config import assumptions_of, load_config
    from ros2cc_extract.spec.close import Policy
    from ros2cc_extract.verify.search.options import Options

    config = load_config(path)
    return Job(
        paths=[path],
        config=config,
        policy=Policy(rclpy=release),
        options=Options(limits=Limits(seconds=SECONDS_A_MODEL)),
        assumptions=replace(assumptions_of(config, []), rclpy=release),
        root=config.root.resolve(),
        cached=cached,
        max_seconds=MOST_SECONDS,
    )


def _keep(path: Path | None, shown: Sequence[Confirmation], stderr: TextIO) -> None:
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.confirm.schedules import write_schedule

    if path is not None and shown:
        write_atomically(path, write_schedule(shown[0].schedule))
        print(f'wrote {path}; repeat it with confirm --replay {path}', file=stderr)
