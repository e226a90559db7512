#!/usr/bin/env python3
"""
Installs each wheel where no compiler is, and runs the tests of the native parts on it.

``python -m release.trial [DIR]``: x86-64 wheels in a new virtual environment of their version,
aarch64 ones under ``qemu-aarch64-static`` with Debian's CPython. For the others there is no
interpreter: they are named, and only auditwheel has seen them.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from release.debian import aarch64_python
from release.sources import ROOT
from release.targets import interpreters

WORK = ROOT / 'build' / 'trial'
TESTS = ('tests/unit/checker', 'tests/unit/live', 'tests/unit/cli')
# An emulated processor takes some twelve times as long: the core, the journal and their twins.
EMULATED_TESTS = (
    'tests/unit/checker/test_chains.py',
    'tests/unit/checker/test_counts.py',
    'tests/unit/checker/test_language.py',
    'tests/unit/checker/test_threads.py',
    'tests/unit/live/test_journal.py',
    'tests/unit/live/test_native.py',
)
NEEDED = ('pytest', 'pytest-rerunfailures', 'hypothesis')
SEEN = """
import resource, sys
from ros2cc_extract.checker import _core
from ros2cc_extract.extract.live import _journal
from ros2cc_extract.cli.main import main
assert main(['launch_free_examples/service_deadlock/node.py'], sys.stdout, sys.stderr) == 1
print('seconds of CPU:', sum(resource.getrusage(resource.RUSAGE_SELF)[:2]), file=sys.stderr)
"""


@dataclass(frozen=True)
class Wheel:
    """A wheel, and what its name says of it."""

    path: Path
    version: str
    machine: str
    is_musl: bool

    @property
    def tag(self) -> str:
        return self.path.stem.split('-', 2)[2]


@dataclass(frozen=True)
class Outcome:
    """What came of one wheel; ``passed`` is nothing where it could not be tried."""

    wheel: Wheel
    passed: bool | None
    told: str


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('folder', type=Path, nargs='?', default=ROOT / 'dist')
    args = parser.parse_args()
    wheels = [wheel_of(path.resolve()) for path in sorted(args.folder.glob('*.whl'))]
    outcomes = []
    for wheel in wheels:
        outcome = tried(wheel)
        word = {None: 'not run', True: 'passed', False: 'FAILED'}[outcome.passed]
        print(f'{word:8}{wheel.tag}: {outcome.told}', flush=True)
        outcomes.append(outcome)
    return 0 if outcomes and all(outcome.passed is not False for outcome in outcomes) else 1


def wheel_of(path: Path) -> Wheel:
    named = re.search(r'-cp3(\d+)-cp3\d+-\w*?(musl|many)linux.*_(x86_64|aarch64)\.whl$', path.name)
    if not named:
        raise SystemExit(f'{path.name} is none of our wheels')
    minor, libc, machine = named.groups()
    return Wheel(path, f'3.{minor}', machine, libc == 'musl')


def tried(wheel: Wheel) -> Outcome:
    folder = WORK / wheel.tag
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    if wheel.is_musl:
        return Outcome(wheel, None, 'there is no CPython on musl here')
    python = installed_here(wheel, folder)
    if wheel.machine == 'aarch64':
        python = installed_there(wheel, folder)
    if not python:
        return Outcome(wheel, None, f'there is no CPython {wheel.version} for {wheel.machine}')
    return judged(wheel, python, folder)


def installed_here(wheel: Wheel, folder: Path) -> list[str]:
    """Install into an environment of this machine; nothing where its version is not here."""
    found = interpreters().get(wheel.version)
    if wheel.machine != os.uname().machine or not found:
        return []
    subprocess.run([found.path, '-m', 'venv', folder / 'venv'], check=True)
    python = str(folder / 'venv/bin/python')
    install([python, '-m', 'pip'], wheel, [])
    return [python]


def installed_there(wheel: Wheel, folder: Path) -> list[str]:
    """Install what another machine would, into a folder."""
    python = aarch64_python(wheel.version, WORK)
    if not python:
        return []
    there = [f'--platform=manylinux2014_{wheel.machine}', f'--python-version={wheel.version}']
    there += [f'--platform=manylinux_2_{minor}_{wheel.machine}' for minor in (17, 28)]
    there += ['--implementation=cp', f'--target={folder / "site"}']
    install([sys.executable, '-m', 'pip'], wheel, there)
    return python


def install(pip: list[str], wheel: Wheel, how: list[str]) -> None:
    quiet = ['--quiet', '--disable-pip-version-check', '--only-binary=:all:']
    subprocess.run([*pip, 'install', *quiet, *how, wheel.path, *NEEDED], check=True)


def judged(wheel: Wheel, python: list[str], folder: Path) -> Outcome:
    """Run the demonstration and the tests beside the package, not over its sources."""
    tree = folder / 'tree'
    for name in ('tests', 'launch_free_examples'):
        shutil.copytree(ROOT / name, tree / name, ignore=shutil.ignore_patterns('__pycache__'))
    shutil.copy(ROOT / 'pyproject.toml', tree)
    environment = {
        'PATH': str(folder / 'nothing'),
        'HOME': str(folder),
        'PYTHONPATH': str(folder / 'site'),
        'XDG_CACHE_HOME': str(folder / 'cache'),
    }
    tests = TESTS
    if len(python) > 1:
        tests = (*EMULATED_TESTS, '--hypothesis-profile=emulated')
    commands = (['-c', SEEN], ['-m', 'pytest', '-q', '-p', 'no:cacheprovider', *tests])
    told = []
    for command in commands:
        done = subprocess.run(
            [*python, *command], cwd=tree, env=environment, capture_output=True, text=True
        )
        (folder / 'output').write_text(done.stdout + done.stderr, encoding='utf-8')
        lines = (done.stderr or done.stdout).strip().splitlines() or ['']
        told.append(lines[-1])
        if done.returncode:
            return Outcome(wheel, False, f'{lines[-1]}; see {folder / "output"}')
    return Outcome(wheel, True, '; '.join(told))


if __name__ == '__main__':
    sys.exit(main())
