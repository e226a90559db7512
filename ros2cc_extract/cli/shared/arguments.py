"""Arguments that several subcommands share; nothing slow is imported before it is needed."""

from __future__ import annotations

import argparse
import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ros2cc_extract.jobs.pools import Pool
    from ros2cc_extract.spec.close import Policy
    from ros2cc_extract.verify.search.options import Options


def add_paths(parser: argparse.ArgumentParser) -> None:
    """Add the files and directories to scan."""
    parser.add_argument(
        'paths', nargs='+', type=Path, metavar='PATH', help='a Python file or a directory'
    )
    add_cache_argument(parser)


def add_launch_paths(parser: argparse.ArgumentParser) -> None:
    """Add the files and directories to scan, and arguments of launch files among them."""
    parser.add_argument(
        'paths',
        nargs='+',
        metavar='PATH',
        help='a Python file, a launch file or a directory; NAME:=VALUE for launch files',
    )
    add_cache_argument(parser)


def add_watch_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the watch of processes that are started with the hook."""
    parser.add_argument(
        '--watch',
        type=number_of_seconds,
        metavar='SECONDS',
        help='explain, as `why` does, where no callback has ended for so long, and keep the last '
        'steps before it',
    )
    parser.add_argument(
        '--diagnostics',
        action='store_true',
        help='with --watch: publish the verdict on /diagnostics, once a second',
    )


def live_environment(args: argparse.Namespace) -> Mapping[str, str]:
    """
    Give the environment for processes that are started with the hook.

    :raises InputError: when diagnostics are asked for and no watch.
    """
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.extract.live.environment import publishing

    if not args.diagnostics:
        return os.environ
    if args.watch is None:
        raise InputError('--diagnostics publishes what --watch finds', None, 'add --watch 5')
    return publishing(os.environ)


def add_cache_argument(parser: argparse.ArgumentParser) -> None:
    """Add the choice to scan afresh."""
    parser.add_argument(
        '--no-cache', action='store_true', help='ignore earlier results and scan again'
    )


def add_unit_arguments(parser: argparse.ArgumentParser, *, ranges: bool = False) -> None:
    """Add what closes holes of a unit; with ``ranges`` a sweep may be asked for."""
    parser.add_argument(
        '--threads',
        type=_range if ranges else _single,
        metavar='N|A..B' if ranges else 'N',
        help='number of executor threads, instead of that in the source'
        + ('; a range gives one table for all' if ranges else ''),
    )
    parser.add_argument(
        '--builtin',
        action='store_true',
        help='model the entities that rclpy itself creates, too',
    )
    release = parser.add_mutually_exclusive_group()
    release.add_argument(
        '--rclpy',
        type=_version,
        metavar='VERSION',
        help='version of rclpy that runs the node: 7.1.6 is Jazzy, 9.1.2 Kilted (default: the '
        'recorded one, else what all releases have in common)',
    )
    release.add_argument(
        '--distro',
        dest='rclpy',
        choices=['humble', 'jazzy', 'kilted', 'lyrical', 'rolling'],
        help='ROS distribution that runs the node: what all its releases have in common',
    )


def add_model_arguments(
    group: argparse._ActionsContainer, *, text: str, ranges: bool = False
) -> None:
    """Add which model of a unit is meant; ``text`` is the default text."""
    group.add_argument(
        '--profile', choices=['paper', 'rclpy'], default='paper', help='model profile'
    )
    group.add_argument(
        '--text',
        choices=['plain', 'compact'],
        default=text,
        help='plain: as published; compact: same verdicts, fewer states (default %(default)s)',
    )
    group.add_argument(
        '--max-cycle',
        type=_bounds if ranges else _bound,
        default=(1,),
        metavar='N|A..B|inf' if ranges else 'N|inf',
        help='how often each callback becomes ready (default 1, as published); inf: without '
        'limit, '
        'where starvation needs --fairness weak',
    )


def add_search_arguments(
    parser: argparse.ArgumentParser, *, seconds: float | None, ranges: bool = False
) -> None:
    """Add profile, limits and the choice of the engine; ``seconds`` is the default limit."""
    group = parser.add_argument_group('verification')
    add_model_arguments(group, text='compact', ranges=ranges)
    group.add_argument(
        '--checker',
        choices=['embedded', 'verifyta'],
        default='embedded',
        help="the embedded checker, or UPPAAL's own (default: embedded)",
    )
    group.add_argument(
        '--verifyta',
        type=Path,
        metavar='PROGRAM',
        help='path of verifyta (default: search for it)',
    )
    group.add_argument(
        '--one-by-one', action='store_true', help='start verifyta once for each query'
    )
    group.add_argument(
        '--engine',
        choices=['auto', 'native', 'reference'],
        default='auto',
        help='native core or plain Python (default: native if it is built)',
    )
    group.add_argument(
        '--fairness',
        choices=['none', 'weak'],
        default='none',
        help='weak: running callbacks end, and an executor that can move does',
    )
    group.add_argument(
        '--no-reduction', action='store_true', help='explore every state of the model'
    )
    group.add_argument(
        '--jobs',
        type=positive,
        default=1,
        metavar='N',
        help='explore a large model with N threads (default 1); the result is the same',
    )
    group.add_argument('--max-states', type=positive, metavar='N', help='stop after N states')
    group.add_argument('--max-memory', type=positive, metavar='MB', help='stop above MB megabytes')
    limit = f' (default {seconds:g})' if seconds else ''
    group.add_argument(
        '--timeout',
        type=number_of_seconds,
        default=seconds,
        metavar='S',
        help=f'stop after S seconds for each model{limit}; the rest is undecided',
    )


def add_node_arguments(parser: argparse.ArgumentParser, *, confirms: bool = False) -> None:
    """Add how a program is started; with ``confirms`` also that it is to be."""
    group = parser.add_argument_group('on the running node')
    if confirms:
        group.add_argument(
            '--confirm',
            action='store_true',
            help='start the programs, and try to show each finding, as the command confirm does',
        )
    group.add_argument(
        '--yes', action='store_true', help='start a program without asking; its code runs'
    )
    group.add_argument(
        '--python',
        metavar='PROGRAM',
        help='the interpreter that has rclpy (default: this one, else python3)',
    )
    group.add_argument(
        '--stub-missing',
        action='store_true',
        help='put stand-ins that do nothing in place of modules that are not installed',
    )


def add_dask_argument(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the option for what runs the jobs, which ``what`` names."""
    parser.add_argument(
        '--dask',
        metavar='tcp://HOST:PORT',
        help=f'have {what} verified by the workers of this Dask scheduler (extra dask)',
    )


def pool_of(args: argparse.Namespace) -> Pool | None:
    """The cluster that ``--dask`` names, ``None`` without one."""
    if args.dask is None:
        return None
    from ros2cc_extract.jobs.dask_cluster import cluster_at

    return cluster_at(args.dask)


def policy_of(args: argparse.Namespace) -> Policy:
    """Collect what ``add_unit_arguments`` declared."""
    from ros2cc_extract.spec.close import Policy

    threads = args.threads[0] if args.threads else None
    return Policy(builtin=args.builtin, threads=threads, rclpy=args.rclpy)


def options_of(args: argparse.Namespace) -> Options:
    """Collect what ``add_search_arguments`` declared."""
    from ros2cc_extract.checker.engines.limits import Limits
    from ros2cc_extract.checker.engines.terms import EngineKind, Fairness
    from ros2cc_extract.generator.template_files import Profile, Text
    from ros2cc_extract.verify.search.options import Checker, Options
    from ros2cc_extract.verify.uppaal.verifyta_processes import Runs

    return Options(
        checker=Checker(args.checker),
        verifyta=args.verifyta,
        runs=Runs.ONE_BY_ONE if args.one_by_one else Runs.TOGETHER,
        profile=Profile(args.profile),
        text=Text(args.text),
        max_cycle=args.max_cycle[0],
        engine=EngineKind[args.engine.upper()],
        fairness=Fairness[args.fairness.upper()],
        reduction=not args.no_reduction,
        limits=Limits(states=args.max_states, memory_mb=args.max_memory, seconds=args.timeout),
        jobs=args.jobs,
    )


def positive(text: str) -> int:
    """Read a whole number above 0."""
    value = int(text) if text.isascii() and text.isdigit() else 0
    if value < 1:
        raise argparse.ArgumentTypeError(f'{text!r} is not a whole number above 0')
    return value


def release_argument(text: str) -> str:
    """Read a release, or the name of a distribution."""
    from ros2cc_extract.spec.releases.lines import BY_DISTRO, release_of

    if text not in BY_DISTRO and release_of(text) is None:
        known = ', '.join(BY_DISTRO)
        raise argparse.ArgumentTypeError(
            f'{text!r} is not a release; write 7.1.6, or one of {known}'
        )
    return text


def _version(text: str) -> str:
    if not text.split('.')[0].isdecimal():
        raise argparse.ArgumentTypeError(f'{text!r} is not a version; write 7.1.6')
    return text


def _bounds(text: str) -> tuple[int | None, ...]:
    return (None,) if text == 'inf' else tuple(_range(text))


def _bound(text: str) -> tuple[int | None, ...]:
    return (None,) if text == 'inf' else tuple(_single(text))


def _single(text: str) -> range:
    number = positive(text)
    return range(number, number + 1)


def _range(text: str) -> range:
    """Read ``4`` or ``1..8``, both ends included."""
    first, dots, last = text.partition('..')
    low, high = positive(first), positive(last if dots else first)
    if low > high:
        raise argparse.ArgumentTypeError(f'{text!r} is empty; write {high}..{low}')
    return range(low, high + 1)


def number_of_seconds(text: str) -> float:
    """Read a number of seconds above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float('inf'):
        raise argparse.ArgumentTypeError(f'{text!r} is not a number of seconds above 0')
    return value
