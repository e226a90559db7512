"""
``ros2cc-extract spec``: the YAML specification on stdout, one document per unit.

With ``--check`` nothing is written: the source must still say what the committed file says.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_cache_argument
from ros2cc_extract.cli.shared.exit_status import (
    EXIT_CLEAN,
    EXIT_ERROR,
    EXIT_FINDINGS,
    EXIT_UNDECIDED,
)

if TYPE_CHECKING:
    from ros2cc_extract.extract.extraction import Extraction


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'paths', nargs='*', type=Path, metavar='PATH', help='a Python file or a directory'
    )
    parser.add_argument(
        '--check',
        type=Path,
        metavar='FILE',
        help='compare with FILE, print the differences, and exit with status 1 if there are any',
    )
    parser.add_argument('-o', '--output', type=Path, metavar='FILE', help='write to FILE instead')
    add_cache_argument(parser)
    parser.add_argument(
        '--strict', action='store_true', help='exit with status 3 if a fact is unresolved'
    )
    parser.add_argument(
        '--builtin', action='store_true', help='also list the entities that rclpy itself creates'
    )
    parser.add_argument('--schema', action='store_true', help='print the JSON Schema')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    if args.schema:
        stdout.write(_schema())
        return EXIT_CLEAN
    from ros2cc_extract.errors import InputError
    from ros2cc_extract.pipeline.sources import (
        has_barred,
        has_unread,
        nothing_read,
        print_diagnostics,
        scan_sources,
    )

    if not args.paths:
        raise InputError('no path given', None, 'name a Python file or a directory')
    extraction = scan_sources(
        args.paths, stderr, cached=not args.no_cache, lists_builtin=args.builtin
    )
    print_diagnostics(extraction.diagnostics, stderr)
    has_drift = False
    if args.check is not None:
        has_drift = _has_drift(args, extraction, stdout, stderr)
    else:
        _write(args, extraction, stdout, stderr)
    if nothing_read(args.paths, extraction):
        return EXIT_ERROR
    if has_drift:
        return EXIT_FINDINGS
    if args.strict and has_barred(extraction.diagnostics):
        return EXIT_ERROR
    unresolved = any(unit.unresolved for unit in extraction.units)
    unresolved = unresolved or has_unread(extraction.diagnostics)
    return EXIT_UNDECIDED if args.strict and unresolved else EXIT_CLEAN


def _write(
    args: argparse.Namespace, extraction: Extraction, stdout: TextIO, stderr: TextIO
) -> None:
    from ros2cc_extract.cli.shared.output import write_text
    from ros2cc_extract.report.text.confidence import confidence_lines
    from ros2cc_extract.spec.confidence import confidence_in
    from ros2cc_extract.spec.yaml.yaml_io import write_specs

    if extraction.units:
        write_text(write_specs(extraction.units), args.output, stdout)
        for line in confidence_lines(confidence_in(extraction.units)):
            print(line, file=stderr)
    else:
        print(f'no rclpy node found in {len(extraction.files_seen)} files', file=stderr)


def _has_drift(
    args: argparse.Namespace, extraction: Extraction, stdout: TextIO, stderr: TextIO
) -> bool:
    from ros2cc_extract.compare.drift import drift
    from ros2cc_extract.report.text.drift import print_drift
    from ros2cc_extract.report.text.style import console_for
    from ros2cc_extract.spec.yaml.yaml_io import load_specs

    found = drift(load_specs(args.check), extraction.units)
    print_drift(found, str(args.check), console_for(stdout))
    if found:
        sources = ' '.join(map(str, args.paths))
        print(f'to accept: ros2cc-extract spec {sources} -o {args.check}', file=stderr)
    return bool(found)


def _schema() -> str:
    from importlib.resources import files

    return files('ros2cc_extract.spec.yaml').joinpath('schema.json').read_text(encoding='utf-8')
