"""``ros2cc-extract diff``: what two specifications of one program, or system, say differently."""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_FINDINGS
from ros2cc_extract.cli.shared.running import add_running_arguments, running_sides

if TYPE_CHECKING:
    from ros2cc_extract.compare.merge import Difference
    from ros2cc_extract.spec.model import Spec


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = (
        'Where a side is a launch file, a system specification, a folder of recordings or '
        '--running, both\nare compared as systems: nodes, names, endpoints, types, quality of '
        'service.\n\n'
        'Exit status: 0 no difference, or only in facts that one side marks as conditional or '
        'unknown;\n1 a difference; 2 input error.'
    )
    parser.usage = '%(prog)s [options] LEFT (RIGHT | --running) [ARG:=VALUE …]'
    parser.add_argument(
        'sides',
        nargs='+',
        metavar='LEFT RIGHT',
        help='a YAML specification (- for standard input), Python source, a launch file, or a '
        'folder of recordings',
    )
    add_running_arguments(parser)
    parser.add_argument('--output-format', choices=['text', 'json', 'mermaid'], default='text')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.files import DISK
    from ros2cc_extract.pipeline.system_paths import names_system
    from ros2cc_extract.pipeline.system_sources import divided

    paths, arguments = divided(args.sides)
    if len(paths) != (1 if args.running else 2):
        mend = 'as in: diff old.yaml new.yaml, or: diff robot.launch.py --running'
        raise InputError(f'{len(paths)} paths given', None, mend)
    if args.running or arguments or any(names_system(path, DISK) for path in paths):
        return _of_systems(paths, arguments, args, stdout, stderr)
    return _of_units(paths, args.output_format, stdout, stderr)


def _of_units(paths: Sequence[Path], form: str, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.compare.merge import diff
    from ros2cc_extract.pipeline.sources import load_units

    left, right = (load_units(path, stderr) for path in paths)
    differences = diff(left, right)
    if form == 'mermaid':
        return _draw(differences, (('before', left), ('after', right)), stdout)
    return report(differences, (str(paths[0]), str(paths[1])), form, stdout)


def _of_systems(
    paths: Sequence[Path],
    arguments: Mapping[str, str],
    args: argparse.Namespace,
    stdout: TextIO,
    stderr: TextIO,
) -> int:
    from ros2cc_extract.compare.systems import diff_systems
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.files import DISK
    from ros2cc_extract.pipeline.sources import print_diagnostics
    from ros2cc_extract.pipeline.system_paths import sides_of

    if args.output_format == 'mermaid':
        raise InputError('no picture of two systems is drawn', None, 'write text or json')
    sides = [side for path in paths for side in sides_of([path], arguments, stderr, DISK)]
    sides += running_sides(args)
    print_diagnostics([d for side in sides for d in side.diagnostics], stderr)
    left, right = sides
    differences = diff_systems(left.only, right.only)
    return report(differences, (left.label, right.label), args.output_format, stdout)


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
