"""``ros2cc-extract explore``: run nodes under many schedules."""

from __future__ import annotations

import argparse
import functools
import shlex
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_node_arguments, number_of_seconds, positive
from ros2cc_extract.cli.shared.exit_status import (
    EXIT_CLEAN,
    EXIT_ERROR,
    EXIT_FINDINGS,
    EXIT_INTERRUPTED,
)

if TYPE_CHECKING:
    from ros2cc_extract.explore.exploring import Exploration
    from ros2cc_extract.explore.scenario import Row, Scenario
    from ros2cc_extract.explore.watching import Process
    from ros2cc_extract.spec.model import Spec

DEFAULT_SCHEDULES, DEFAULT_SECONDS = 100, 300.0
DEFAULT_STEPS, DEPTH_FIRST = 20, 'depth-first'
DEFAULT_FOLDER = Path('ros2cc-explore')
EPILOG = """\
examples:
  ros2cc-extract explore -- python my_node.py
  ros2cc-extract explore --schedules 500 --first -- ros2 run my_package my_node
  ros2cc-extract explore --replay ros2cc-explore/1-hang-my_node-24.json

Starts the command again and again, and beside it a stimulus that sends what the nodes wait for
from outside, in a ROS domain of their own and on this machine only; all of it is killed in the
end. A schedule decides which callback begins next, and which thread goes on at a wait, a lock or a
shared attribute. Reports hangs, exceptions and lost updates, each with a file that --replay
repeats. Asks before it runs a command for the first time. Exit status: 1 something was found (or
repeated), 0 nothing was, 2 it could not be tried.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = '%(prog)s [options] (-- CMD … | --replay FILE)'
    parser.epilog = EPILOG
    parser.add_argument(
        '--schedules',
        type=positive,
        default=DEFAULT_SCHEDULES,
        metavar='N',
        help='run N schedules (default %(default)s)',
    )
    parser.add_argument(
        '--max-seconds',
        type=number_of_seconds,
        default=DEFAULT_SECONDS,
        metavar='S',
        help='end after S seconds (default %(default)g)',
    )
    _add_choices(parser)
    parser.add_argument(
        '--source',
        type=Path,
        action='append',
        metavar='PATH',
        help='scan this file or directory for waits and shared attributes (default: the files of '
        'the callbacks that have run)',
    )
    parser.add_argument(
        '--no-stimulus', action='store_true', help='send the nodes nothing: they have partners'
    )
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=DEFAULT_FOLDER,
        metavar='DIR',
        help='folder for the files that --replay repeats (default %(default)s)',
    )
    parser.add_argument('--replay', type=Path, metavar='FILE', help='repeat a failure')
    parser.add_argument('--output-format', choices=('text', 'json'), default='text')
    add_node_arguments(parser)
    parser.add_argument('command', nargs=argparse.REMAINDER, metavar='-- CMD …')


def _add_choices(parser: argparse.ArgumentParser) -> None:
    """Add which schedules are run, and when they end."""
    parser.add_argument(
        '--strategy',
        choices=('mixed', 'pct', 'random', 'preemptions', DEPTH_FIRST),
        default='mixed',
        help='random priorities (pct), a random walk, both in turn (mixed, the default), few '
        'preemptions, or all orders of the first steps of a small node (depth-first)',
    )
    parser.add_argument(
        '--steps',
        type=positive,
        default=DEFAULT_STEPS,
        metavar='N',
        help='of depth-first: order the first N steps (default %(default)s)',
    )
    parser.add_argument('--seed', type=int, default=1, metavar='N', help='of all that is random')
    parser.add_argument('--first', action='store_true', help='end with the first failure')
    parser.add_argument(
        '--fresh',
        action='store_true',
        help='start the command anew for each schedule; slower, and nothing is left from before',
    )
    parser.add_argument(
        '--without-gil',
        action='store_true',
        help='switch threads between any two accesses, as an interpreter without its global lock '
        'does (default: only where this interpreter can)',
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.errors import InputError

    command = args.command[1:] if args.command[:1] == ['--'] else args.command
    if bool(command) == (args.replay is not None):
        mend = 'as in: explore -- python my_node.py'
        raise InputError('one command after --, or --replay', None, mend)
    return (
        _replay(args, stdout, stderr) if args.replay else _explore(args, command, stdout, stderr)
    )


def _python_of(args: argparse.Namespace, command: Sequence[str]) -> str:
    """Return the interpreter for the stimulus: that of the command, if it names one."""
    from ros2cc_extract.cli.shared.on_node import interpreter_of

    named = Path(command[0]).name.startswith('python') and not args.python
    return command[0] if named else interpreter_of(args)


def _explore(
    args: argparse.Namespace, command: Sequence[str], stdout: TextIO, stderr: TextIO
) -> int:
    from ros2cc_extract.confirm.consent import ask_to_run
    from ros2cc_extract.confirm.processes import release_of
    from ros2cc_extract.explore.exploring import Exploration
    from ros2cc_extract.explore.watching import run_process

    begun = time.monotonic()
    python = _python_of(args, command)
    release = release_of(python)
    ask_to_run(shlex.join(command), stderr, yes=args.yes)
    deadline = begun + args.max_seconds
    so_far = Exploration()
    show = functools.partial(_show, args, begun, stderr)
    scenario: Scenario | None = None
    units: Sequence[Spec] = ()
    try:
        scenario, units = _first_look(args, command, python, so_far)
        show(so_far)
        if so_far.found and args.first:
            so_far.why_ended = 'a failure was found'
        else:
            ready = functools.partial(
                run_process,
                scenario,
                python=python,
                stubs=args.stub_missing,
                deadline=deadline,
                until=lambda _: args.first,
            )
            _run_schedules(args, ready, (scenario, units), deadline, so_far, show)
    except KeyboardInterrupt:
        so_far.why_ended = 'interrupted'
    _clear(stderr)
    _report(args, so_far, (scenario, len(units), release, begun), stdout, stderr)
    if so_far.found:
        return EXIT_FINDINGS
    if so_far.why_ended == 'interrupted':
        return EXIT_INTERRUPTED
    return EXIT_CLEAN if so_far.begins else EXIT_ERROR


def _run_schedules(
    args: argparse.Namespace,
    ready: Callable[[Sequence[Row]], Process],
    looked: tuple[Scenario, Sequence[Spec]],
    deadline: float,
    so_far: Exploration,
    show: Callable[[Exploration], None],
) -> None:
    from ros2cc_extract.explore.depth_first import Search, dependence_of, search
    from ros2cc_extract.explore.exploring import Budget, Strategy, explore

    budget = Budget(
        schedules=args.schedules,
        deadline=deadline,
        a_process=1 if args.fresh else Budget.a_process,
        only_first=args.first,
    )
    if args.strategy != DEPTH_FIRST:
        explore(ready, Strategy(args.strategy), args.seed, budget, so_far, show)
        return
    scenario, units = looked
    found = Search(args.steps, frozenset(scenario.known))
    try:
        search(ready, dependence_of(units), found, budget, so_far, show)
    finally:
        so_far.statement = found.words


def _first_look(
    args: argparse.Namespace, command: Sequence[str], python: str, so_far: Exploration
) -> tuple[Scenario, Sequence[Spec]]:
    """
    Run the program as it comes, and scan what has run.

    :raises InputError: where no process of the command loads rclpy.
    """
    from ros2cc_extract.explore.first_look import first_look

    return first_look(
        command,
        python,
        so_far,
        given=args.source,
        is_sent=not args.no_stimulus,
        stubs=args.stub_missing,
        everywhere=args.without_gil,
    )


def _report(
    args: argparse.Namespace,
    so_far: Exploration,
    known: tuple[Scenario | None, int, str | None, float],
    stdout: TextIO,
    stderr: TextIO,
) -> None:
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.explore.scenario import write_found
    from ros2cc_extract.explore.wording import (
        as_json,
        file_name,
        found_as_text,
        limits_of,
        summary,
    )

    scenario, sources, release, begun = known
    files = {}
    for number, each in enumerate(so_far.found):
        if scenario is not None:
            args.output.mkdir(parents=True, exist_ok=True)
            files[number] = args.output / file_name(each, number + 1)
            write_atomically(files[number], write_found(each, scenario, release))
        if args.output_format == 'text':
            stdout.write(found_as_text(each, files.get(number)))
    seconds = time.monotonic() - begun
    limits = limits_of(so_far, len(scenario.points) if scenario else 0, sources)
    if args.output_format == 'json':
        stdout.write(as_json(so_far, files, seconds=seconds, release=release, limits=limits))
        return
    for each_limit in limits:
        print(f'note: {each_limit}', file=stdout)
    if so_far.statement:
        print(so_far.statement, file=stdout)
    print(summary(so_far, seconds), file=stdout)
    if not so_far.begins:
        for line in [line for line in so_far.last_words.splitlines() if line.strip()][-3:]:
            print(f'  {line}', file=stderr)


def _show(args: argparse.Namespace, begun: float, stderr: TextIO, so_far: Exploration) -> None:
    if stderr.isatty():
        count = len(so_far.found)
        what = f'{count} failure{"" if count == 1 else "s"}'
        seconds = time.monotonic() - begun
        text = f'schedule {so_far.done} of {args.schedules}, {what}, {seconds:.0f} s'
        print(f'\r\x1b[K{text}', end='', file=stderr, flush=True)


def _clear(stderr: TextIO) -> None:
    if stderr.isatty():
        print('\r\x1b[K', end='', file=stderr, flush=True)


def _replay(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.confirm.consent import ask_to_run
    from ros2cc_extract.confirm.processes import release_of
    from ros2cc_extract.explore.replaying import replay
    from ros2cc_extract.explore.scenario import read_found
    from ros2cc_extract.explore.watching import run_process
    from ros2cc_extract.explore.wording import replay_as_json, replay_as_text

    scenario, found = read_found(args.replay)
    python = _python_of(args, scenario.command)
    # Before all else: the interpreter, too, may be one that the file names.
    ask_to_run(shlex.join(scenario.command), stderr, yes=args.yes)
    release_of(python)
    deadline = time.monotonic() + args.max_seconds

    def once(rows: Sequence[Row], until: object) -> Process:
        return run_process(
            scenario,
            rows,
            python,
            stubs=args.stub_missing,
            deadline=deadline,
            until=until,  # type: ignore[arg-type]
        )

    result = replay(found, once)
    shown = replay_as_json if args.output_format == 'json' else replay_as_text
    stdout.write(shown(found, result))
    return EXIT_CLEAN if result.failure is None else EXIT_FINDINGS
