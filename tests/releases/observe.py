"""
What rclpy does, row by row of the table of behaviours: a program of ``rows/`` for each.

``python -m tests.releases.observe RELEASE...`` runs them on releases, those that are no wheel by
``tests/conformance/releases.py``, and writes down in ``observed.yaml`` what they said.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import yaml

from ros2cc_extract.spec.releases.behaviour import Behaviour
from ros2cc_extract.spec.releases.table import (
    EXCEPTION_AFTER_AWAIT_LOST,
    FUTURE_YIELDS_ITSELF,
    ROWS,
    SHUTDOWN_WAITS_NOT,
    SPIN_REFUSED_TWICE,
    SPIN_YIELDS,
    TASKS_OLDEST_FIRST,
    THREADS_BY_AFFINITY,
    TIMEOUT_KEEPS_HARVEST,
    UNTIL_ASKS_FUTURE,
)
from tests.conformance.releases import CORES, RELEASES, VARIABLE, built
from tests.conformance.suite import Release, own_environment

HERE, ROOT = Path(__file__).parent, Path(__file__).parents[2]
OBSERVED = HERE / 'observed.yaml'
FOLDER = ROOT / 'build' / 'releases'
WHEELS = {
    '7.1.6': str(ROOT / '.venv-jazzy/bin/python'),
    '9.1.2': str(ROOT / '.venv-kilted/bin/python'),
}
OF_CORES = (
    TASKS_OLDEST_FIRST,
    FUTURE_YIELDS_ITSELF,
    UNTIL_ASKS_FUTURE,
    EXCEPTION_AFTER_AWAIT_LOST,
    SPIN_REFUSED_TWICE,
    TIMEOUT_KEEPS_HARVEST,
    SHUTDOWN_WAITS_NOT,
    THREADS_BY_AFFINITY,
    SPIN_YIELDS,
)
"""Rows that `executors.py` and `task.py` alone decide."""
WATCHDOG_S = 120
AT_ONCE = 3
HOLDS = {'yes': True, 'no': False}


def program_of(row: Behaviour) -> Path:
    """The program that shows whether a release has a behaviour; a row may have none."""
    return HERE / 'rows' / f'{row.name.replace("-", "_")}.py'


def read_observed() -> dict[str, dict[str, bool]]:
    """What was observed: row by row, for each release."""
    read: dict[str, dict[str, bool]] = yaml.safe_load(OBSERVED.read_text())
    return read


def observe(python: str, release: Release | None) -> Iterator[tuple[str, bool]]:
    """Run the programs on one release, several at a time: they mostly wait."""
    is_core = release is not None and release.version in CORES
    rows = [row for row in (OF_CORES if is_core else ROWS) if program_of(row).exists()]

    def told_of(row: Behaviour) -> str:
        with own_environment() as environment:
            given = environment if release is None else release.over(environment)
            return said(python, program_of(row), given)

    with ThreadPoolExecutor(AT_ONCE) as pool:
        for row, told in zip(rows, pool.map(told_of, rows), strict=True):
            if told in HOLDS:
                yield row.name, HOLDS[told]


def said(python: str, program: Path, environment: dict[str, str]) -> str:
    """The last line of a program."""
    ran = subprocess.run(
        [python, str(program)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=WATCHDOG_S,
        check=False,
    )
    lines = ran.stdout.split('\n')[-2:-1]
    assert lines, f'{program.name} says nothing: {ran.stderr}'
    return lines[0]


def main() -> None:
    observed = read_observed() if OBSERVED.exists() else {}
    for version in sys.argv[1:] or (*WHEELS, *RELEASES, *CORES):
        if version in WHEELS:
            python, release = WHEELS[version], None
        else:
            python, release = built(version, Path(os.environ[VARIABLE]), FOLDER)
        for name, holds in observe(python, release):
            observed.setdefault(name, {})[version] = holds
            print(version, name, holds, flush=True)
    OBSERVED.write_text(yaml.safe_dump(observed, sort_keys=True))


if __name__ == '__main__':
    main()
