"""``ros2cc-extract explain``: what a rule says, why it holds in rclpy, and how to mend it."""

from __future__ import annotations

import argparse
from typing import TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'codes', nargs='*', metavar='CODE', help='such as CC101; without a code, list all rules'
    )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.findings.explain import explain
    from ros2cc_extract.findings.rules.registry import RULES

    if not args.codes:
        for rule in RULES:
            print(f'{rule.code}  {rule.severity.value:<7}  {rule.title}', file=stdout)
        return EXIT_CLEAN
    stdout.write('\n'.join(explain(code) for code in args.codes))
    return EXIT_CLEAN
