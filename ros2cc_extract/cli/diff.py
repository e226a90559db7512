"""``ros2cc-extract diff``: what two specifications of one program say differently."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.main import EXIT_CLEAN, EXIT_FINDINGS


def add_arguments(parser: argparse.ArgumentParser) -> None:
    for name in ('left', 'right'):
        parser.add_argument(
            name, type=Path, metavar=name.upper(), help='a YAML specification, or Python source'
        )
    parser.add_argument('--output-format', choices=['text', 'json'], default='text')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.sources import load_units
    from ros2cc_extract.merge import diff

    differences = diff(load_units(args.left, stderr), load_units(args.right, stderr))
    if args.output_format == 'json':
        from ros2cc_extract.report.json_report import differences_data, to_text

        stdout.write(to_text(differences_data(differences)))
    else:
        from ros2cc_extract.report.diff_text import print_differences
        from ros2cc_extract.report.style import console_for

        print_differences(differences, (str(args.left), str(args.right)), console_for(stdout))
    faulty = any(not difference.marked for difference in differences)
    return EXIT_FINDINGS if faulty else EXIT_CLEAN
