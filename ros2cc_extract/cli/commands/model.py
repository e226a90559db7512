"""``ros2cc-extract model``: the UPPAAL model, its queries and the published tool's files."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.arguments import add_model_arguments, add_unit_arguments, policy_of
from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN
from ros2cc_extract.text_escaping import one_line

if TYPE_CHECKING:
    from ros2cc_extract.generator.build import RenderedModel


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'path',
        type=Path,
        metavar='PATH|SPEC',
        help='a Python file, a directory, or a YAML file (- for standard input)',
    )
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='DIR', help='folder to write to'
    )
    parser.add_argument(
        '--svg', action='store_true', help='also draw each automaton, as UPPAAL shows it'
    )
    add_unit_arguments(parser)
    add_model_arguments(parser.add_argument_group('model'), text='plain')


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.cli.shared.releases import report_releases
    from ros2cc_extract.generator.build import Profile, Text, render
    from ros2cc_extract.pipeline.sources import load_units
    from ros2cc_extract.spec.close import close

    policy = policy_of(args)
    closed_units = [
        close(unit, policy) for unit in load_units(args.path, stderr, lists_builtin=args.builtin)
    ]
    report_releases((closed.spec.rclpy for closed in closed_units), stderr)
    folders = unit_folders([closed.spec.name for closed in closed_units], args.output)
    for closed, folder in zip(closed_units, folders, strict=True):
        rendered = render(
            closed,
            profile=Profile(args.profile),
            text=Text(args.text),
            max_cycle=args.max_cycle[0],
        )
        for assumption in closed.assumptions:
            print(f'{rendered.name}: assumed: {assumption}', file=stderr)
        files = {**model_files(rendered), **(_drawings(rendered) if args.svg else {})}
        for name, text in files.items():
            write_atomically(folder / name, text)
            print(one_line(str(folder / name)), file=stdout)
    return EXIT_CLEAN


def unit_folders(names: Sequence[str], output: Path) -> list[Path]:
    """One folder per unit: ``output`` itself, but for units that share their name."""
    uses = Counter(names)
    return [
        output if uses[name] == 1 else output / f'{number}_{name}'
        for number, name in enumerate(names, start=1)
    ]


def model_files(rendered: RenderedModel) -> Mapping[str, str]:
    """File name to text, of everything one unit gives."""
    return {
        f'{rendered.name}.xml': rendered.xml,
        f'{rendered.name}.q': rendered.q,
        **rendered.published,
    }


def _drawings(rendered: RenderedModel) -> Mapping[str, str]:
    from ros2cc_extract.generator.svg import draw

    return {f'{rendered.name}_{name}.svg': text for name, text in draw(rendered.xml).items()}
