"""``ros2cc-extract env``: the hook by environment variables, for launch files and services."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.shared.arguments import add_watch_arguments, live_environment
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'usage: eval "$(ros2cc-extract env -o DIR)", then start the nodes as usual. While they '
        'run, '
        'or\nafterwards: ros2cc-extract collect DIR'
    )
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='DIR', help='folder of the recordings'
    )
    parser.add_argument('--trace', action='store_true', help='also record the execution')
    add_watch_arguments(parser)


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import make_folder
    from ros2cc_extract.extract.live.environment import shell_commands

    environment = live_environment(args)
    make_folder(args.output)
    stdout.write(shell_commands(environment, args.output, traced=args.trace, limit_s=args.watch))
    return EXIT_CLEAN
