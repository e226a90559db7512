"""``ros2cc-extract env``: the hook by environment variables, for launch files and services."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'use: eval "$(ros2cc-extract env -o DIR)", then start the nodes as always; read what they '
        'hold,\nwhile they run or afterwards, by: ros2cc-extract collect DIR'
    )
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='DIR', help='folder of the recordings'
    )
    parser.add_argument('--trace', action='store_true', help='also record the execution')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    import os

    from ros2cc_extract.cli.shared.output import make_folder
    from ros2cc_extract.extract.live.environment import shell_commands

    make_folder(args.output)
    stdout.write(shell_commands(os.environ, args.output, traced=args.trace))
    return EXIT_CLEAN
