"""``ros2cc-extract system``: the specification of the system that launch files start."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_cache_argument
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN, EXIT_UNDECIDED

if TYPE_CHECKING:
    from ros2cc_extract.spec.system.model import System


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'paths',
        nargs='*',
        metavar='PATH|ARG:=VALUE',
        help='a launch file (Python, XML or YAML), or an argument of it',
    )
    parser.add_argument(
        '--output-format',
        choices=['yaml', 'json', 'mermaid', 'dot'],
        default='yaml',
        help='the specification, or a picture (default %(default)s)',
    )
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')
    add_cache_argument(parser)
    parser.add_argument(
        '--strict', action='store_true', help='exit with status 3 if a fact is unresolved'
    )
    parser.add_argument('--schema', action='store_true', help='print the JSON Schema')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import write_text
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.files import DISK
    from ros2cc_extract.pipeline.sources import print_diagnostics
    from ros2cc_extract.pipeline.system import divided
    from ros2cc_extract.pipeline.system_sources import scan_launch_files
    from ros2cc_extract.spec.system.system_yaml import system_schema

    if args.schema:
        stdout.write(system_schema())
        return EXIT_CLEAN
    paths, arguments = divided(args.paths)
    if not paths:
        raise InputError('no path given', None, 'name a launch file')
    scanned = scan_launch_files(paths, arguments, stderr, cached=not args.no_cache, files=DISK)
    print_diagnostics(scanned.extraction.diagnostics, stderr)
    write_text(_written(scanned.system, args.output_format), args.output, stdout)
    is_open = bool(scanned.system.unresolved)
    return EXIT_UNDECIDED if args.strict and is_open else EXIT_CLEAN


def _written(system: System, form: str) -> str:
    from ros2cc_extract.report.system_pictures import dot, mermaid
    from ros2cc_extract.spec.system.system_yaml import system_data, write_system

    if form == 'mermaid':
        return mermaid(system)
    if form == 'dot':
        return dot(system)
    if form == 'json':
        return json.dumps(system_data(system), indent=2) + '\n'
    return write_system(system)
