"""``ros2cc-extract init``: writes the test file, hook and job that guard a ROS 2 package."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.cli.shared.exit_status import EXIT_CLEAN
from ros2cc_extract.light_dataclasses import dataclass

if TYPE_CHECKING:
    from ros2cc_extract.packages.manifest import Package

SNIPPETS = 'ros2cc_extract.packages.snippets'
SOURCE = '@SOURCE@'
OF_REPOSITORY = {
    'pre_commit': ('pre-commit-config.yaml', '.pre-commit-config.yaml'),
    'github': ('github-workflow.yml', '.github/workflows/ros2cc.yml'),
    'gitlab': ('gitlab-ci.yml', '.gitlab/ros2cc.yml'),
}


@dataclass(frozen=True)
class Target:
    """A file to write, and what stands in it."""

    path: Path
    text: str


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        'folder',
        nargs='?',
        type=Path,
        default=Path(),
        metavar='DIR',
        help='a ROS 2 package (default: the current folder)',
    )
    parser.add_argument(
        '--install',
        metavar='SOURCE',
        help='what the jobs install: a commit of the repository, or a wheel (default: what is '
        'installed here)',
    )
    for name, what in (
        ('--pre-commit', 'hooks for pre-commit'),
        ('--github', 'a job for GitHub Actions'),
        ('--gitlab', 'a job for GitLab CI'),
    ):
        parser.add_argument(
            name, action='store_true', help=f'also write {what}, at the top of the repository'
        )


def run(args: argparse.Namespace, stdout: TextIO, stderr: TextIO) -> int:
    from ros2cc_extract.packages.manifest import read_package

    package = read_package(args.folder)
    wanted = [name for name in OF_REPOSITORY if getattr(args, name)]
    for target in (_test_of(package), *_of_repository(package, wanted, args.install)):
        _write(target, stdout, stderr)
    for advice in _advice(package):
        for line in advice.splitlines():
            print(line, file=stderr)
    return EXIT_CLEAN


def _test_of(package: Package) -> Target:
    return Target(package.folder / 'test' / 'test_ros2cc.py', _snippet('test_ros2cc.txt'))


def _of_repository(package: Package, wanted: list[str], source: str | None) -> list[Target]:
    top = _repository(package.folder)
    found = []
    for name, path in (OF_REPOSITORY[each] for each in wanted):
        text = _snippet(name)
        if SOURCE in text:
            from ros2cc_extract.packages.origin import pinned_source

            text = text.replace(SOURCE, pinned_source(source))
        found.append(Target(top / path, text))
    return found


def _repository(folder: Path) -> Path:
    """The folder at or above ``folder`` that git knows; without one, ``folder``."""
    for candidate in (folder.resolve(), *folder.resolve().parents):
        if (candidate / '.git').exists():
            return candidate
    return folder


def _snippet(name: str) -> str:
    from importlib.resources import files

    return files(SNIPPETS).joinpath(name).read_text(encoding='utf-8')


def _write(target: Target, stdout: TextIO, stderr: TextIO) -> None:
    from ros2cc_extract.cli.shared.output import write_atomically
    from ros2cc_extract.pipeline.sources import read_input

    shown = _shown(target.path)
    if not target.path.exists():
        write_atomically(target.path, target.text)
        print(f'wrote {shown}', file=stderr)
    elif read_input(target.path) == target.text:
        print(f'{shown} is up to date', file=stderr)
    else:
        print(f'kept {shown}, which is there already; what it may hold:', file=stderr)
        stdout.write(target.text)


def _shown(path: Path) -> Path:
    here = Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path


def _advice(package: Package) -> list[str]:
    advice = []
    missing = sorted({'python3-pytest', 'ros2cc_extract'} - package.dependencies)
    if missing:
        named = ' '.join(f'<test_depend>{name}</test_depend>' for name in missing)
        advice.append(f'{package.folder / "package.xml"}: add {named}')
    if package.build_type == 'ament_cmake':
        advice.append(
            f'{package.folder / "CMakeLists.txt"}: under BUILD_TESTING add '
            'find_package(ament_cmake_pytest REQUIRED) and '
            'ament_add_pytest_test(ros2cc test/test_ros2cc.py)'
        )
    return advice
