"""``ros2cc-extract merge``: one specification of what the source and a live run say."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN

if TYPE_CHECKING:
    from ros2cc_extract.spec.model import Spec


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Facts that the source does not know come from the run. Where known facts differ, the '
        'source '
        'wins\nand a line says so; `diff` lists all differences.'
    )
    parser.add_argument('static', type=Path, metavar='STATIC', help='specification or source')
    parser.add_argument('live', type=Path, metavar='LIVE', help='specification of a live run')
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')


def _report_conflicts(pair: tuple[Spec, Spec], args: argparse.Namespace, stderr: TextIO) -> None:
    """Say which known facts differ: the first side's are kept."""
    from ros2cc_extract.compare.merge import Kind, diff_units

    for found in diff_units(*pair):
        if found.kind is Kind.DIFFERS and not found.marked:
            sides = (
                (args.static, found.left, found.left_place),
                (args.live, found.right, found.right_place),
            )
            both = ', '.join(
                f'{value} in {file}{f" ({place})" if place else ""}'
                for file, value, place in sides
            )
            what = f'{found.unit}: {found.fact} of {found.subject}: {both}; the first is kept'
            print(f'ros2cc-extract: {what}', file=stderr)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import write_text
    from ros2cc_extract.compare.merge import match_units, merge_units
    from ros2cc_extract.pipeline.sources import load_units
    from ros2cc_extract.spec.yaml.yaml_io import write_specs

    pairs, only_static, only_live = match_units(
        load_units(args.static, stderr), load_units(args.live, stderr)
    )
    if not pairs:
        what = f'no unit of {args.static} is one of {args.live}; all are written as they are'
        print(f'ros2cc-extract: {what}', file=stderr)
    for pair in pairs:
        _report_conflicts(pair, args, stderr)
    merged = [merge_units(*pair) for pair in pairs]
    write_text(write_specs([*merged, *only_static, *only_live]), args.output, stdout)
    return EXIT_CLEAN
