"""``ros2cc-extract upgrade``: what changes for a program when another release runs it."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_paths, release_argument
from ros2cc_extract.cli.shared.exit_status import (
    EXIT_CLEAN,
    EXIT_ERROR,
    EXIT_FINDINGS,
    EXIT_UNDECIDED,
)

if TYPE_CHECKING:
    from ros2cc_extract.findings.upgrade import Change, Side
    from ros2cc_extract.pipeline.check import Outcome
    from ros2cc_extract.verify.results.results import Verification

SECONDS, MAX_SECONDS = 20.0, 120.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_paths(parser)
    for name, what in (('from', 'that runs the nodes now'), ('to', 'that will run them')):
        parser.add_argument(
            f'--{name}',
            dest=f'{name}_release',
            required=True,
            type=release_argument,
            metavar='RELEASE',
            help=f'release {what}: a version such as 7.1.6, or a distribution (its newest known '
            'release)',
        )
    parser.epilog = 'Exit status: 0 nothing changes, 1 something does, 2 input error, 3 undecided.'


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.findings.upgrade import changes, not_compared
    from ros2cc_extract.pipeline.sources import has_unread, nothing_read
    from ros2cc_extract.spec.releases.lines import newest_of

    old, new = newest_of(args.from_release), newest_of(args.to_release)
    report_releases((old, new), stderr)
    before = _checked(args, old, {}, stderr)
    answered = dict(zip(before.models, before.judged, strict=True))
    after = _checked(args, new, answered, stderr)
    _print_unread(after, stderr)
    if nothing_read(args.paths, after.extraction):
        return EXIT_ERROR
    alike = frozenset(before.models).intersection(after.models)
    sides = _side(before, old, alike), _side(after, new, alike)
    found = changes(after.units, *sides, after.extraction.idle)
    for change in found:
        print(_line(change), file=stdout)
        for row in change.because:
            print(f'    because of {row.name}: {row.source}', file=stdout)
    open_units = sorted(not_compared(*sides))
    for unit in open_units:
        print(f'{unit}: not all of it is compared, because a limit was reached', file=stdout)
    count = f'{len(found)} change{"" if len(found) == 1 else "s"}' if found else 'no change'
    print(f'from rclpy {old} to {new}: {count}', file=stdout)
    if found:
        return EXIT_FINDINGS
    is_open = bool(open_units or after.extraction.cut)
    return EXIT_UNDECIDED if is_open or has_unread(after.extraction.diagnostics) else EXIT_CLEAN


def _print_unread(outcome: Outcome, stderr: TextIO) -> None:
    """Nothing is compared in a file that was not read, which the reader must know."""
    from ros2cc_extract.findings.collect import is_unread

    for finding in outcome.findings:
        if is_unread(finding):
            print(f'{finding.place}: {finding.message}', file=stderr)


def _side(outcome: Outcome, release: str, alike: frozenset[str]) -> Side:
    """
    What one release does.

    :param alike: models that both releases have; what is open there is the same for both.
    """
    from ros2cc_extract.findings.upgrade import Side

    rows = zip(outcome.units, outcome.judged, outcome.models, strict=True)
    undecided = (unit.name for unit, judged, model in rows if judged.is_cut and model not in alike)
    return Side(release=release, findings=outcome.findings, undecided=frozenset(undecided))


def _checked(
    args: argparse.Namespace,
    release: str,
    answered: Mapping[str, Verification],
    stderr: TextIO,
) -> Outcome:
    from ros2cc_extract.checker.api import Limits
    from ros2cc_extract.pipeline.check import Job, check_paths
    from ros2cc_extract.pipeline.config import assumptions_of, load_config
    from ros2cc_extract.spec.close import Policy
    from ros2cc_extract.verify.search.options import Options

    config = load_config(min(args.paths, key=lambda path: path.absolute()))
    job = Job(
        paths=args.paths,
        config=config,
        policy=Policy(rclpy=release),
        options=Options(limits=Limits(seconds=config.timeout or SECONDS)),
        assumptions=replace(assumptions_of(config, []), rclpy=release),
        root=config.root.resolve(),
        cached=not args.no_cache,
        max_seconds=MAX_SECONDS,
        answered=answered,
    )
    outcome = check_paths(job, stderr)
    if outcome.interrupted:
        raise KeyboardInterrupt
    return outcome


def _line(change: Change) -> str:
    code = f'{change.code} ' if change.code else ''
    return f'{change.place}: {code}{change.turn.value}: {change.message}'
