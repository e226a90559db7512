"""``ros2cc-extract attach``: the specification of a process that already runs."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

DEFAULT_OUTPUT = Path('live.spec.yaml')


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'The process keeps running. Measurements, traces and places of creation need `run` or '
        '`env`\nfrom the start. Needs Python 3.14 on both sides, or: pip install "pyinjector>=1.3"'
    )
    parser.add_argument('pid', type=int, metavar='PID', help='process id of the node')
    parser.add_argument(
        '-o',
        '--output',
        type=Path,
        default=DEFAULT_OUTPUT,
        metavar='FILE',
        help=f'specification file (default {DEFAULT_OUTPUT})',
    )
    parser.add_argument(
        '--other-user',
        action='store_true',
        help='also attach to a process of another user (as root; read docs/live.md first)',
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.extract.live.attach import attach_process

    return attach_process(args.pid, args.output, stderr, other_user=args.other_user)
