#!/usr/bin/env python3
"""
Installs each wheel where no compiler is, and runs an example and the tests of its native parts.

``python -m release.trial [DIR] [--only TEXT] [--short]``: x86-64 wheels in a new virtual
environment of their version, aarch64 ones under ``qemu-aarch64-static`` with Debian's CPython, on
musl with one that is built of Debian's sources where ``musl-gcc`` is. Without one the native
parts of such a wheel are bound by Debian's musl, and no more. A wheel without an interpreter is
named: only auditwheel has seen it.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from release.audit import PARTS
from release.debian import aarch64_python, musl_loader
from release.environments import QUIET, made
from release.musl import musl_python
from release.sources import ROOT
from release.targets import UNPACKED, interpreters

WORK = ROOT / 'build' / 'trial'
TESTS = ('tests/unit/checker', 'tests/unit/live', 'tests/unit/cli')
# An emulated processor takes some eight times as long: the core, the journal and their twins.
EMULATED_TESTS = (
    'tests/unit/checker/test_chains.py',
    'tests/unit/checker/test_counts.py',
    'tests/unit/checker/test_language.py',
    'tests/unit/checker/test_threads.py',
    'tests/unit/live/test_journal.py',
    'tests/unit/live/test_native.py',
)
# The limit of 20 s for a unit is of the clock on the wall: there it can pass before the search.
EMULATED_LIMITS = ('--timeout=1800', '--max-seconds=3600')
NEEDED = ('pytest', 'pytest-rerunfailures', 'hypothesis')
SEEN = """
import io, resource, sys
from ros2cc_extract.checker import _core
from ros2cc_extract.extract.live import _journal
from ros2cc_extract.extract.live.ptrace_entry import library
from ros2cc_extract.cli.main import main
sys.path[0:0] = [sys.argv[1]]
from release.demonstration import EXAMPLE, differing
assert library(), 'there is no _enter'
stdout, stderr = io.StringIO(), io.StringIO()
status = main(['check', EXAMPLE, '--verdicts', *sys.argv[2:]], stdout, stderr)
differences = differing(status, stdout.getvalue(), stderr.getvalue())
used = resource.getrusage(resource.RUSAGE_SELF)
sys.exit(differences or print(f'true result in {used.ru_utime + used.ru_stime:.2f} s of CPU'))
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
    parser.add_argument('--only', default='', help='a part of the names that are tried')
    parser.add_argument('--short', action='store_true', help='the example and no tests')
    args = parser.parse_args()
    wheels = [wheel_of(path.resolve()) for path in sorted(args.folder.glob('*.whl'))]
    outcomes = []
    for wheel in wheels:
        if args.only not in wheel.tag:
            continue
        outcome = tried(wheel, is_short=args.short)
        word = {None: 'not run', True: 'passed', False: 'FAILED'}[outcome.passed]
        print(f'{word:8}{wheel.tag}: {outcome.told}', flush=True)
        outcomes.append(outcome)
    count = [outcome.passed for outcome in outcomes].count
    print(f'{count(True)} passed, {count(False)} failed, {count(None)} not run')
    return 0 if outcomes and not count(False) else 1


def wheel_of(path: Path) -> Wheel:
    named = re.search(r'-cp3(\d+)-cp3\d+-\w*?(musl|many)linux.*_(x86_64|aarch64)\.whl$', path.name)
    if not named:
        raise SystemExit(f'{path.name} is none of our wheels')
    minor, libc, machine = named.groups()
    return Wheel(path, f'3.{minor}', machine, libc == 'musl')


def tried(wheel: Wheel, *, is_short: bool) -> Outcome:
    folder = WORK / wheel.tag
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    is_here = wheel.machine == os.uname().machine
    if wheel.is_musl:
        built = musl_python(wheel.version, UNPACKED) if is_here else None
        if not built:
            return loaded(wheel, folder)
        python = [str(built)]
        install([sys.executable, '-m', 'pip'], wheel, told_to_pip(wheel, folder / 'site'))
    else:
        python = installed_here(wheel, folder) if is_here else installed_there(wheel, folder)
    if not python:
        return Outcome(wheel, None, f'there is no CPython {wheel.version} for {wheel.machine}')
    return judged(wheel, python, folder, is_short=is_short)


def loaded(wheel: Wheel, folder: Path) -> Outcome:
    """Let musl's loader bind the native parts: what it does not find must be CPython's own."""
    loader = musl_loader(wheel.machine, UNPACKED)
    if not loader:
        return Outcome(wheel, None, f'there is no musl for {wheel.machine}')
    with zipfile.ZipFile(wheel.path) as archive:
        parts = [name for name in archive.namelist() if name.endswith('.so')]
        archive.extractall(folder, parts)
    missing = [name for part in parts for name in unbound([*loader, '--list', str(folder / part)])]
    told = ', '.join(missing) or f'{len(parts)} native parts bound by musl; there is no CPython'
    return Outcome(wheel, False if missing or len(parts) != len(PARTS) else None, told)


def unbound(command: Sequence[str]) -> list[str]:
    """Give what the loader complains of, but for symbols that the interpreter brings."""
    said = subprocess.run(command, capture_output=True, text=True).stderr
    complaints = [line for line in said.splitlines() if line.startswith('Error ')]
    return [line for line in complaints if not re.search(r': _?Py\w+: symbol not found$', line)]


def installed_here(wheel: Wheel, folder: Path) -> list[str]:
    """Install into an environment of this machine; nothing where its version is not here."""
    found = interpreters().get(wheel.version)
    if not found:
        return []
    python = str(made(found.path, folder / 'venv'))
    install([python, '-m', 'pip'], wheel, [])
    return [python]


def installed_there(wheel: Wheel, folder: Path) -> list[str]:
    """Install what another machine would, into a folder."""
    python = aarch64_python(wheel.version, UNPACKED)
    if not python:
        return []
    site = folder / 'site'
    install([sys.executable, '-m', 'pip'], wheel, told_to_pip(wheel, site))
    here = interpreters().get(wheel.version)
    if here:
        # Its byte code is the same on every machine, and emulated it takes most of the time.
        library = Path(python[-1]).parents[1] / f'lib/python{wheel.version}'
        compiling = [here.path, '-m', 'compileall', '-q', '-j', '1', site, library]
        subprocess.run(compiling, check=False, stdout=subprocess.DEVNULL)
    return python


def told_to_pip(wheel: Wheel, site: Path) -> list[str]:
    """Give what lets pip choose what runs on another system, and put it into a folder."""
    platforms = (
        [f'musllinux_1_{minor}_{wheel.machine}' for minor in (1, 2)]
        if wheel.is_musl
        else [f'manylinux{glibc}_{wheel.machine}' for glibc in ('2014', '_2_17', '_2_28')]
    )
    there = [f'--platform={platform}' for platform in platforms]
    there += [f'--python-version={wheel.version}', '--implementation=cp']
    return [*there, f'--target={site}', '--no-compile']


def install(pip: list[str], wheel: Wheel, how: list[str]) -> None:
    binary = [*QUIET, '--only-binary=:all:']
    subprocess.run([*pip, 'install', *binary, *how, wheel.path, *NEEDED], check=True)


def judged(wheel: Wheel, python: list[str], folder: Path, *, is_short: bool) -> Outcome:
    """Run the example and the tests beside the package, not over its sources."""
    tree = folder / 'tree'
    for name in ('tests', 'launch_free_examples', 'release'):
        shutil.copytree(ROOT / name, tree / name, ignore=shutil.ignore_patterns('__pycache__'))
    shutil.copy(ROOT / 'pyproject.toml', tree)
    environment = {
        'PATH': str(folder / 'nothing'),
        'HOME': str(folder),
        'PYTHONPATH': str(folder / 'site'),
        'XDG_CACHE_HOME': str(folder / 'cache'),
    }
    is_emulated = len(python) > 1
    tests = EMULATED_TESTS if is_emulated else TESTS
    commands = [('-c', SEEN, str(tree), *(EMULATED_LIMITS if is_emulated else ()))]
    if not is_short:
        commands.append(('-m', 'pytest', '-q', '-p', 'no:cacheprovider', *tests))
    told = []
    for command in commands:
        done = subprocess.run(
            [*python, *command], cwd=tree, env=environment, capture_output=True, text=True
        )
        with (folder / 'output').open('a', encoding='utf-8') as output:
            output.write(done.stdout + done.stderr)
        lines = (done.stderr or done.stdout).strip().splitlines() or ['']
        told.append(lines[-1])
        if done.returncode:
            return Outcome(wheel, False, f'{lines[-1]}; see {folder / "output"}')
    return Outcome(wheel, True, '; '.join(told))


if __name__ == '__main__':
    sys.exit(main())
