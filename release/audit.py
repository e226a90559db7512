#!/usr/bin/env python3
"""
Lets auditwheel say on which systems each wheel runs, and holds its name against that.

``python -m release.audit [DIR]``: also all native parts must be in each, named for its version.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
import zipfile
from pathlib import Path

from release.sources import ROOT

PARTS = ('checker/_core', 'extract/live/_journal', 'extract/live/_enter')


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('folder', type=Path, nargs='?', default=ROOT / 'dist')
    wheels = sorted(parser.parse_args().folder.glob('*.whl'))
    complaints = [complaint for wheel in wheels for complaint in faults(wheel)]
    for complaint in complaints:
        print(complaint)
    print(f'{len(wheels)} wheels audited, {len(complaints)} faults')
    return 0 if wheels and not complaints else 1


def faults(wheel: Path) -> list[str]:
    command = [sys.executable, '-m', 'auditwheel', 'show', wheel]
    done = subprocess.run(command, capture_output=True, text=True)
    said = ' '.join(done.stdout.split())
    found = re.search(r'consistent with the following platform tag: "(\w+)"', said)
    told = []
    if not found or found[1] not in wheel.stem.split('-')[-1].split('.'):
        told.append(f'{wheel.name}: auditwheel says {found[1] if found else said + done.stderr}')
    if 'external shared libraries are required by the wheel' in said:
        told.append(f'{wheel.name}: needs shared libraries that the system does not promise')
    return told + [f'{wheel.name}: {part} is not there once' for part in missing(wheel)]


def missing(wheel: Path) -> list[str]:
    """Give the parts that are not there exactly once, under the name of this version."""
    version = wheel.stem.split('-')[2].removeprefix('cp')
    names = zipfile.ZipFile(wheel).namelist()
    return [part for part in PARTS if suffixes(part, names) != [f'cpython-{version}']]


def suffixes(part: str, names: list[str]) -> list[str]:
    start = f'ros2cc_extract/{part}.'
    built = [name.removeprefix(start) for name in names if name.startswith(start)]
    return ['-'.join(name.split('-')[:2]) for name in built if name.endswith('.so')]


if __name__ == '__main__':
    sys.exit(main())
