"""``ros2cc-extract system``: the specification of what runs beside each other."""

from __future__ import annotations

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_cache_argument
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_ERROR, EXIT_UNDECIDED
from ros2cc_extract.cli.shared.running import add_running_arguments, running_sides

if TYPE_CHECKING:
    from ros2cc_extract.pipeline.system_paths import Side
    from ros2cc_extract.spec.system.model import System

EPILOG = """\
PATH is a launch file (Python, XML or YAML; several are one system), a folder of code (one system
for each launch file in it, or one of all its programs), a folder of recordings as `env` and
`collect` have it, or a system specification. --running is what runs now, by the ROS graph.
The facts of several of these are joined, and what one has and another lacks is reported on
standard error.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    parser.add_argument(
        'paths',
        nargs='*',
        metavar='PATH|ARG:=VALUE',
        help='what to read, or an argument of a launch file',
    )
    parser.add_argument(
        '--output-format',
        choices=['yaml', 'json', 'html', 'mermaid', 'dot'],
        default='yaml',
        help='the specification, a page, or a picture (default %(default)s)',
    )
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')
    add_running_arguments(parser)
    add_cache_argument(parser)
    parser.add_argument(
        '--strict', action='store_true', help='exit with status 3 if a fact is unresolved'
    )
    parser.add_argument('--schema', action='store_true', help='print the JSON Schema')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import write_text
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.files import DISK
    from ros2cc_extract.pipeline.sources import has_barred, has_unread, print_diagnostics
    from ros2cc_extract.pipeline.system_paths import sides_of
    from ros2cc_extract.pipeline.system_sources import divided
    from ros2cc_extract.spec.system.system_yaml import system_schema

    if args.schema:
        stdout.write(system_schema())
        return EXIT_CLEAN
    paths, arguments = divided(args.paths)
    sides = sides_of(paths, arguments, stderr, DISK, cached=not args.no_cache)
    sides += running_sides(args)
    if not sides:
        mend = 'name a launch file or a folder, or look at what runs by --running'
        raise InputError('no path given', None, mend)
    noticed = [d for side in sides for d in side.diagnostics]
    print_diagnostics(noticed, stderr)
    systems = sides[0].systems if len(sides) == 1 else (_joined(sides, stderr),)
    write_text(_written(systems, args.output_format), args.output, stdout)
    if args.strict and has_barred(noticed):
        return EXIT_ERROR
    is_open = any(system.unresolved for system in systems) or has_unread(noticed)
    return EXIT_UNDECIDED if args.strict and is_open else EXIT_CLEAN


def _joined(sides: Sequence[Side], stderr: TextIO) -> System:
    """Merge all sides; report what is missing from one and in another."""
    from ros2cc_extract.compare.system_merge import merge_systems
    from ros2cc_extract.compare.systems import diff_systems
    from ros2cc_extract.report.text.diff import difference_lines

    whole, label = sides[0].only, sides[0].label
    for side in sides[1:]:
        differences = diff_systems(whole, side.only)
        for line in difference_lines(differences, (label, side.label)):
            print(line, file=stderr)
        whole, label = merge_systems(whole, side.only), f'{label} + {side.label}'
    return whole


def _written(systems: Sequence[System], form: str) -> str:
    from ros2cc_extract.report.html.system_page import system_page
    from ros2cc_extract.report.system_pictures import dot, mermaid
    from ros2cc_extract.spec.system.system_yaml import system_data, write_systems

    if form in ('mermaid', 'dot'):
        return mermaid(systems) if form == 'mermaid' else dot(systems)
    if form == 'html':
        return system_page(systems)
    if form == 'json':
        data = [system_data(system) for system in systems]
        return json.dumps(data[0] if len(data) == 1 else data, indent=2) + '\n'
    return write_systems(systems)
