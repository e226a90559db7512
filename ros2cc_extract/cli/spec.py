"""``ros2cc-extract spec``: the YAML specification on stdout, one document per unit."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.main import EXIT_CLEAN, EXIT_ERROR, EXIT_UNDECIDED


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'paths', nargs='*', type=Path, metavar='PATH', help='a Python file or a directory'
    )
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')
    parser.add_argument('--strict', action='store_true', help='exit 3 when a fact is unresolved')
    parser.add_argument('--schema', action='store_true', help='print the JSON Schema')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    if args.schema:
        stdout.write(_schema())
        return EXIT_CLEAN
    from ros2cc_extract.cli.output import write_text
    from ros2cc_extract.cli.sources import has_errors, print_diagnostics, scan_sources
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.spec.yaml_io import write_specs

    if not args.paths:
        raise InputError('no path given', None, 'name a Python file or a directory')
    extraction = scan_sources(args.paths, stderr)
    print_diagnostics(extraction.diagnostics, stderr)
    if extraction.units:
        write_text(write_specs(extraction.units), args.output, stdout)
    else:
        print(f'no rclpy node found in {len(extraction.files_seen)} files', file=stderr)
    if has_errors(extraction.diagnostics):
        return EXIT_ERROR
    unresolved = any(unit.unresolved for unit in extraction.units)
    return EXIT_UNDECIDED if args.strict and unresolved else EXIT_CLEAN


def _schema() -> str:
    from importlib.resources import files

    return files('ros2cc_extract.spec').joinpath('schema.json').read_text(encoding='utf-8')
