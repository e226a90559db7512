#!/usr/bin/env python3
"""
Runs tests with the lowest versions of all dependencies that are allowed, and with the newest.

``python -m release.dependencies [lowest newest]``: the lowest on the lowest CPython that is here,
the newest on the newest; the bounds are those of ``pyproject.toml``.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys

from packaging.requirements import Requirement

from release.environments import QUIET, made, watched
from release.sources import ROOT, copied_tree
from release.targets import Interpreter, interpreters

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

WORK = ROOT / 'build' / 'dependencies'
# What reads, writes, draws and parses by them; not what needs a compiler or ROS.
TESTS = ('tests/unit', 'tests/golden', 'tests/e2e/test_examples.py')
TOOLS = {'mypy', 'ruff', 'types-pyyaml', 'pre-commit', 'setuptools', 'pyinjector'}
"""Of the development's dependencies those that no test of these imports."""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('ends', nargs='*', default=['lowest', 'newest'])
    parser.add_argument('--jobs', default='auto', help='of pytest-xdist')
    args = parser.parse_args()
    here = list(interpreters().values())
    done = [judged(end, here[0] if end == 'lowest' else here[-1], args.jobs) for end in args.ends]
    return 0 if here and all(done) else 1


def requirements() -> list[Requirement]:
    """Give what the package needs and what its tests do."""
    project = tomllib.loads((ROOT / 'pyproject.toml').read_text(encoding='utf-8'))['project']
    lines = [*project['dependencies'], *project['optional-dependencies']['dev']]
    found = [Requirement(line) for line in lines]
    return [each for each in found if each.name.lower() not in TOOLS]


def lowest(requirement: Requirement) -> str:
    """Give the lowest version that is allowed, as pip reads it."""
    (bound,) = (each.version for each in requirement.specifier if each.operator == '>=')
    marker = f'; {requirement.marker}' if requirement.marker else ''
    return f'{requirement.name}=={bound}{marker}'


def judged(end: str, interpreter: Interpreter, jobs: str) -> bool:
    folder = WORK / end
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    python = made(interpreter.path, folder / 'venv')
    wanted = [lowest(each) if end == 'lowest' else str(each) for each in requirements()]
    pip = [python, '-m', 'pip', 'install', *QUIET, '--upgrade']
    # PyYAML before 6.0.1 is built for Python 3.10 only by a Cython of before 3.
    (folder / 'build.txt').write_text('cython<3\nsetuptools<70\n', encoding='utf-8')
    constrained = {f'PIP_{name}CONSTRAINT': str(folder / 'build.txt') for name in ('', 'BUILD_')}
    environment = {**os.environ, **(constrained if end == 'lowest' else {})}
    subprocess.run([*pip, *wanted], check=True, env=environment)
    tree = copied_tree(folder / 'tree')
    subprocess.run([*pip, 'setuptools', 'wheel', 'pybind11'], check=True)
    install = [*pip, '--no-deps', '--no-build-isolation', tree]
    subprocess.run(install, check=True, env={**os.environ, 'ROS2CC_NATIVE_BUILD': 'required'})
    for name in ('ros2cc_extract', 'generator'):
        shutil.rmtree(tree / name)
    tests = [python, '-u', '-m', 'pytest', '-q', '-n', jobs, *TESTS]
    passed, told = watched(tests, folder / 'output', tree)
    print(f'{end} on CPython {interpreter.version}: {told}', flush=True)
    return passed


if __name__ == '__main__':
    sys.exit(main())
