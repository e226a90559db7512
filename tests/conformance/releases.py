"""
Conformance on releases of rclpy that are no wheel, which a checkout builds.

``ROS2CC_RELEASES=FOLDER python -m tests.conformance.releases`` expects in FOLDER a program
``build PYTHON RELEASE TARGET``, which puts a release, native part included, over the wheel of
PYTHON into TARGET, and ``overlay``, which does so with its executor core alone. Without a folder
everything is skipped, and said to be.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.spec.releases.lines import line_of
from tests.conformance.suite import Release, run_suite

ROOT = Path(__file__).parents[2]
VARIABLE = 'ROS2CC_RELEASES'
RELEASES = ('3.3.21', '7.1.11', '9.1.5', '10.0.10', '11.0.0')
CORES = ('3.3.10', '7.1.9')
"""Those of which only the executor core is there; the rest stays that of the wheel."""
WHEELS = {'humble': 'jazzy', 'jazzy': 'jazzy'}
"""Whose wheel a release is built over; that of Kilted where none is named."""


def record_of(release: str, folder: Path) -> Path:
    """What is there when a release is built; by this name the hook asks for its version."""
    return folder / release / f'ros_rclpy-{release}.dist-info'


def built(release: str, checkout: Path, folder: Path) -> tuple[str, Release]:
    """Build a release unless it is there; give the interpreter to run it by, too."""
    line = line_of(release)
    wheel = WHEELS.get(line.distro if line else '', 'kilted')
    python, target = str(ROOT / f'.venv-{wheel}/bin/python'), folder / release
    record = record_of(release, folder)
    if not record.is_dir():
        program = 'overlay' if release in CORES else 'build'
        command = [str(checkout / program), python, release, str(target)]
        subprocess.run(command, check=True, stdout=sys.stderr)
        record.mkdir()
        # Otherwise the hook finds the version of the wheel.
        text = f'Metadata-Version: 2.1\nName: ros-rclpy\nVersion: {release}\n'
        (record / 'METADATA').write_text(text)
    return python, Release(release, target.resolve())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1] if __doc__ else '')
    parser.add_argument('releases', nargs='*', default=(*RELEASES, *CORES), help='(default: all)')
    parser.add_argument('--first', type=int, default=700_100, help='first seed')
    parser.add_argument('--programs', type=int, default=50)
    parser.add_argument('--folder', type=Path, default=Path('build/releases'))
    parser.add_argument('--keep', type=Path, help='folder for the traces of failing chunks')
    parser.add_argument('--at-once', type=int, default=1, help='processes; programs mostly wait')
    args = parser.parse_args()
    checkout = os.environ.get(VARIABLE)
    if checkout is None:
        print(f'skipped: {", ".join(args.releases)}; {VARIABLE} names no folder that builds them')
        return 0
    outcomes: set[Outcome] = set()
    for each in args.releases:
        python, release = built(each, Path(checkout), args.folder)
        print(f'rclpy {each}', flush=True)
        tally = run_suite(python, args.first, args.programs, args.keep, release, args.at_once)
        outcomes |= set(tally.outcomes)
    return 0 if outcomes <= {Outcome.CONFORMS} else 1


if __name__ == '__main__':
    sys.exit(main())
