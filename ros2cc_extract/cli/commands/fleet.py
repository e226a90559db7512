"""``ros2cc-extract fleet DIR…``: many repositories in one call, with one result each."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from contextlib import closing
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from ros2cc_extract.cli.commands.check import DEFAULT_MAX_SECONDS, DEFAULT_SECONDS
from ros2cc_extract.cli.shared.arguments import (
    add_cache_argument,
    add_search_arguments,
    add_unit_arguments,
    number_of_seconds,
    options_of,
    policy_of,
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
    from ros2cc_extract.pipeline.fleet import Part, Repository, Result
    from ros2cc_extract.pipeline.progress import Meter

ALL_SECONDS = 3600.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Each repository gets DIR/NAME.json, as check --output-format json writes it. One that\n'
        'has not changed since is not checked again, so that a call goes on where another was\n'
        'cut; --no-cache checks all.'
    )
    parser.add_argument('folders', nargs='+', type=Path, metavar='DIR', help='a repository')
    parser.add_argument(
        '-o', '--output', type=Path, metavar='DIR', required=True, help='folder of the results'
    )
    parser.add_argument(
        '--max-seconds',
        type=number_of_seconds,
        default=ALL_SECONDS,
        metavar='S',
        help='for all repositories together (default %(default)g); each gets '
        f'{DEFAULT_MAX_SECONDS:g} s of it at most',
    )
    add_cache_argument(parser)
    add_unit_arguments(parser)
    add_search_arguments(parser, seconds=DEFAULT_SECONDS)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import make_folder
    from ros2cc_extract.pipeline.fleet import State, repositories
    from ros2cc_extract.pipeline.progress import bar

    make_folder(args.output)
    members = repositories(args.folders)
    termination = Termination()
    results: dict[Repository, Result] = {}
    is_interrupted = False
    try:
        with termination_as_interrupt(termination), bar(stderr, 'checking') as meter:
            _check(members, args, results, meter)
    except KeyboardInterrupt:
        is_interrupted = True
    _print(members, results, stdout)
    if is_interrupted:
        print('interrupted: the same call goes on from here', file=stderr)
        return termination.status
    states = {result.state for result in results.values()}
    if State.FAILED in states:
        return EXIT_ERROR
    if any(result.found['errors'] + result.found['warnings'] for result in results.values()):
        return EXIT_FINDINGS
    is_open = any(result.found['undecided'] for result in results.values())
    return EXIT_UNDECIDED if is_open or states & {State.CUT, State.LEFT} else EXIT_CLEAN


def _check(
    members: Sequence[Repository],
    args: argparse.Namespace,
    results: dict[Repository, Result],
    meter: Meter,
) -> None:
    """Check what has changed; ``results`` holds what is known even if it is interrupted."""
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.deadline import deadline_in
    from ros2cc_extract.jobs.pools import Processes
    from ros2cc_extract.jobs.process_pool import usable_cores
    from ros2cc_extract.pipeline.fleet import check_one

    deadline = deadline_in(args.max_seconds, args.max_seconds)
    parts = []
    for member in members:
        part = _part(member, args, results)
        parts += [part] if part is not None else []
        meter.step(len(results), len(members))
    cores = usable_cores()
    # A repository on one core each, or on all cores where there are fewer of them.
    pool = Processes(cores if len(parts) >= cores else 1)
    with closing(pool.each(partial(check_one, _report, deadline), parts, deadline)) as answers:
        for _, result in answers:
            if result.text:
                write_atomically(_path(args, result.repository), result.text)
            results[result.repository] = result
            meter.step(len(results), len(members))


def _part(
    member: Repository, args: argparse.Namespace, results: dict[Repository, Result]
) -> Part | None:
    """What is to be done for a repository; nothing where its result stands."""
    from ros2cc_extract.errors import Ros2ccError
    from ros2cc_extract.pipeline.fleet import Part, Result, State, kept_result, origin_of

    try:
        job = _job(member, args)
    except Ros2ccError as error:
        results[member] = Result(member, State.FAILED, error=str(error))
        return None
    origin = origin_of(member, job)
    kept = None if args.no_cache else kept_result(member, _path(args, member), origin)
    if kept is not None:
        results[member] = kept
        return None
    return Part(member, job, origin)


def _path(args: argparse.Namespace, member: Repository) -> Path:
    folder: Path = args.output
    return folder / f'{member.name}.json'


def _job(member: Repository, args: argparse.Namespace) -> Job:
    from dataclasses import replace

    from ros2cc_extract.pipeline.check import Job
    from ros2cc_extract.pipeline.config import assumptions_of, load_config

    config = load_config(member.folder)
    assumptions = assumptions_of(config, [])
    return Job(
        paths=[member.folder],
        config=config,
        policy=policy_of(args),
        options=options_of(args),
        assumptions=replace(assumptions, rclpy=args.rclpy or assumptions.rclpy),
        root=config.root.resolve(),
        cached=not args.no_cache,
        shows_verdicts=True,
        keeps_runs=True,
        max_seconds=DEFAULT_MAX_SECONDS,
    )


def _report(job: Job, outcome: Outcome, origin: Mapping[str, Any]) -> str:
    from dataclasses import replace

    from ros2cc_extract.cli.shared.checked import checked_of
    from ros2cc_extract.report.formats import write

    return write(replace(checked_of(outcome, job), more={'origin': origin}), 'json')


def _print(
    members: Sequence[Repository], results: Mapping[Repository, Result], stdout: TextIO
) -> None:
    from ros2cc_extract.pipeline.fleet import Result, State
    from ros2cc_extract.report.text.fleet import fleet_line, print_fleet
    from ros2cc_extract.report.text.style import console_for

    rows = [results.get(member, Result(member, State.LEFT)) for member in members]
    found: Counter[str] = sum((row.found for row in rows), Counter())
    done = sum(row.state in (State.CHECKED, State.UNCHANGED) for row in rows)
    reported = [(row.repository.name, row.summary, row.state.value) for row in rows]
    errors = [f'{row.repository.name}: {row.error}' for row in rows if row.error]
    print_fleet(reported, errors, fleet_line(done, len(members), found), console_for(stdout))
