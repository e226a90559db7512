"""
``ros2 cc …``: the whole command line under the command that every user has.

Loaded by ``ros2`` through the entry point ``ros2cli.command``; importing it needs no ROS.
Source of the interface: ros2cli 0.36.1, ``ros2cli/command/__init__.py``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

try:
    from ros2cli.command import CommandExtension
except ImportError:
    CommandExtension = object

NO_PREFIX = '\0'


class CcCommand(CommandExtension):  # type: ignore[misc]  # of any installed ros2cli
    """Check what the callbacks of Python nodes can do to each other."""

    def add_arguments(
        self,
        parser: argparse.ArgumentParser,
        cli_name: str,
        *,
        argv: Sequence[str] | None = None,
    ) -> None:
        # Options belong to our own parser; without a prefix this one takes them as they are.
        parser.prefix_chars = NO_PREFIX
        parser.add_argument(
            'arguments',
            nargs=argparse.REMAINDER,
            help='PATH… or COMMAND …, as for ros2cc-extract',
        )

    def main(self, *, parser: argparse.ArgumentParser, args: argparse.Namespace) -> int:
        from ros2cc_extract.cli.main import main

        return main(args.arguments or ['--help'], sys.stdout, sys.stderr)
