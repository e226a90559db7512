"""``ros2cc-extract merge``: one specification of what the source and a live run say."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.main import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument('static', type=Path, metavar='STATIC', help='specification or source')
    parser.add_argument('live', type=Path, metavar='LIVE', help='specification of a live run')
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.output import write_text
    from ros2cc_extract.cli.sources import load_units
    from ros2cc_extract.merge import match_units, merge_units
    from ros2cc_extract.spec.yaml_io import write_specs

    pairs, only_static, only_live = match_units(
        load_units(args.static, stderr), load_units(args.live, stderr)
    )
    merged = [merge_units(*pair) for pair in pairs]
    write_text(write_specs([*merged, *only_static, *only_live]), args.output, stdout)
    return EXIT_CLEAN
