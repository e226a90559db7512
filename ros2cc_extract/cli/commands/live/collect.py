"""``ros2cc-extract collect``: the specification of what processes hooked by ``env`` recorded."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

DEFAULT_OUTPUT = Path('live.spec.yaml')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'directory', type=Path, metavar='DIR', help='folder of the recordings, as given to `env`'
    )
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=DEFAULT_OUTPUT,
        metavar='FILE|DIR',
        help=f'specification, or folder for one per process (default {DEFAULT_OUTPUT})',
    )
    parser.add_argument(
        '--trace', type=Path, metavar='FILE', help='also write the recorded executions'
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.extract.live.run import collect_directory

    return collect_directory(args.directory, args.output, stderr, trace=args.trace)
