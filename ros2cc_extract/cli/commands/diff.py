"""``ros2cc-extract diff``: what two specifications of one program say differently."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS

if TYPE_CHECKING:
    from ros2cc_extract.compare.merge import Difference
    from ros2cc_extract.spec.model import Spec


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Exit status: 0 no difference, or only in facts that one side marks as conditional or '
        'unknown;\n1 a difference; 2 input error.'
    )
    for name in ('left', 'right'):
        parser.add_argument(
            name,
            type=Path,
            metavar=name.upper(),
            help='a YAML specification (- for standard input), or Python source',
        )
    parser.add_argument('--output-format', choices=['text', 'json', 'mermaid'], default='text')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.compare.merge import diff
    from ros2cc_extract.pipeline.sources import load_units

    left, right = load_units(args.left, stderr), load_units(args.right, stderr)
    differences = diff(left, right)
    if args.output_format == 'mermaid':
        return _draw(differences, (('before', left), ('after', right)), stdout)
    return report(differences, (str(args.left), str(args.right)), args.output_format, stdout)


def _draw(
    differences: Sequence[Difference],
    sides: tuple[tuple[str, Sequence[Spec]], ...],
    stdout: TextIO,
) -> int:
    """Draw both sides in one chart, with what is different marked."""
    from ros2cc_extract.report.unit_mermaid import sides_diagram

    stdout.write(sides_diagram(sides, {difference.subject for difference in differences}))
    return _status(differences)


def report(
    differences: Sequence[Difference], names: tuple[str, str], form: str, stdout: TextIO
) -> int:
    """Print the differences of two sides and give the exit status they deserve."""
    if form == 'json':
        from ros2cc_extract.report.machine.json_report import differences_data, to_text

        stdout.write(to_text(differences_data(differences)))
    else:
        from ros2cc_extract.report.text.diff import print_differences
        from ros2cc_extract.report.text.style import console_for

        print_differences(differences, names, console_for(stdout))
    return _status(differences)


def _status(differences: Sequence[Difference]) -> int:
    faulty = any(not difference.marked for difference in differences)
    return EXIT_FINDINGS if faulty else EXIT_CLEAN
