"""``ros2cc-extract run``: start any command with the hook, and write what its processes held."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence, Set
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_watch_arguments, live_environment
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_ERROR

if TYPE_CHECKING:
    from ros2cc_extract.spec.model import Spec

DEFAULT_OUTPUT = Path('live.spec.yaml')


EPILOG = """\
examples:
  ros2cc-extract run -- ros2 launch my_robot bringup.launch.py
  ros2cc-extract run -o live.yaml --trace run.jsonl -- python node.py
  ros2cc-extract run --check node.py -- python node.py

End the command as usual (Ctrl-C); then the files are written. Exit status: that of the command; if
that is 0: 1 if --check finds a difference, 2 if the output cannot be written or nothing of the
source ran. --trace also writes FILE.perfetto.json, for ui.perfetto.dev.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.usage = (
        '%(prog)s [-h] [-o FILE|DIR] [--trace FILE] [--check PATH] [--watch S [--diagnostics]] '
        '-- CMD …'
    )
    parser.epilog = EPILOG
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=DEFAULT_OUTPUT,
        metavar='FILE|DIR',
        help=f'specification, or folder for one per process (default {DEFAULT_OUTPUT})',
    )
    parser.add_argument(
        '--trace', type=Path, metavar='FILE', help='also record the execution, as JSON lines'
    )
    parser.add_argument(
        '--check',
        type=Path,
        metavar='PATH',
        help='also scan this source and compare it with the run',
    )
    add_watch_arguments(parser)
    parser.add_argument(
        'command',
        nargs=argparse.REMAINDER,
        metavar='-- CMD …',
        help='the command to run; its child processes are recorded too',
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.extract.live.run import run_command

    command = args.command[1:] if args.command[:1] == ['--'] else args.command
    if not command:
        raise InputError('no command given', None, 'write it after --: run -- python node.py')
    environment = live_environment(args)
    compare = _comparison(args.check, stdout, stderr) if args.check else None

    def finish(live: tuple[Spec, ...]) -> int:
        report_releases((unit.rclpy for unit in live), stderr)
        return compare(live) if compare else EXIT_CLEAN

    return run_command(
        command,
        args.output,
        stderr,
        trace=args.trace,
        limit_s=args.watch,
        environment=environment,
        finish=finish,
    )


def _comparison(source: Path, stdout: TextIO, stderr: TextIO) -> Callable[[tuple[Spec, ...]], int]:
    """Scan before the command starts, so that a bad path costs no run."""
    from ros2cc_extract.cli.commands.diff import report
    from ros2cc_extract.compare.merge import diff
    from ros2cc_extract.pipeline.sources import load_units

    units = load_units(source, stderr)
    named = {name for unit in units for name in unit.nodes}

    def compare(live: tuple[Spec, ...]) -> int:
        scanned = _distinct([unit for unit in live if _is_of(unit, source, units)], named)
        if not scanned:
            mend = 'see above how the command ended, or name the source of what it runs'
            print(
                f'ros2cc-extract: {source}: nothing of it ran, so nothing is compared; {mend}',
                file=stderr,
            )
            return EXIT_ERROR
        started = _started(_distinct(units, named), scanned)
        status = report(diff(started, scanned), (str(source), 'live'), 'text', stdout)
        for unit in _distinct(units, named):
            if unit not in started:
                print(f'not run: {unit.name} of {unit.entry}', file=stdout)
        for unit in live:
            if not _is_of(unit, source, units):
                made = unit.executor.source
                files = [*unit.sources, *([made.file] if made else [])]
                print(f'not scanned: {unit.name}', *files[:1], sep=' of ', file=stdout)
        return status

    return compare


def _started(units: Sequence[Spec], live: Sequence[Spec]) -> list[Spec]:
    """Leave out other programs of a package: those without a unit in the run."""
    from ros2cc_extract.compare.merge import match_units

    entries = {unit.entry for unit, _ in match_units(units, live)[0]}
    return [unit for unit in units if unit.entry is None or not entries or unit.entry in entries]


def _is_of(unit: Spec, source: Path, scanned: Sequence[Spec]) -> bool:
    """Return whether a live unit is made in the files that were scanned, or is one of theirs."""
    from ros2cc_extract.compare.merge import match_units
    from ros2cc_extract.files import real_path

    callbacks = [callback for callback in unit.callbacks if not callback.builtin]
    places = [place for callback in callbacks for place in (callback.source, callback.defined)]
    files = {real_path(place.file) for place in (unit.executor.source, *places) if place}
    within = real_path(source)
    is_within = any(file == within or within in file.parents for file in files)
    return is_within or bool(match_units(scanned, [unit])[0])


def _distinct(units: Sequence[Spec], named: Set[str]) -> list[Spec]:
    """
    Leave out units that another process, or a lap of the program, holds just alike.

    :param named: nodes that the source names; any other may be one of these under a new name.
    """
    from ros2cc_extract.compare.merge import diff

    def is_renamed(unit: Spec) -> bool:
        return named.isdisjoint(unit.nodes)

    def are_alike(one: Spec, other: Spec) -> bool:
        may_be_one = is_renamed(other) or set(one.nodes) == set(other.nodes)
        return may_be_one and all(found.marked for found in diff([one], [other]))

    kept: list[Spec] = []
    for unit in sorted(units, key=is_renamed):
        if not any(are_alike(each, unit) for each in kept):
            kept.append(unit)
    return kept
