"""
Systems started by the real ``launch`` and ``launch_ros``: who stands still, and who goes on.

``python -m tests.systems.by_launch --python PYTHON --sources FOLDER`` starts every launch file of
``second/``. FOLDER holds ``launch``, ``launch_ros``, ``launch_xml``, ``launch_yaml`` and what they
import, as their public repositories have it, and ``share/`` with the index of ament: they run
beside the wheels of rclpy, which have no launch. Nothing of it is in this repository. The last
lines of a launch file name who is observed: it says ``asks`` before it waits and ``goes on``
behind it.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
SECOND = HERE / 'second'
SECONDS = 25.0
QUIET_S = 6.0
"""What says nothing for so long, at a period of 0.2 s, stands still."""
LAUNCH = """\
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource

service = LaunchService()
source = AnyLaunchDescriptionSource(sys.argv[1])
service.include_launch_description(LaunchDescription([IncludeLaunchDescription(source)]))
sys.exit(service.run())
"""
_OBSERVED = re.compile(r'^(?:#|<!--) observed: (\w+)', re.MULTILINE)


@dataclass
class Running:
    """One started system; ``said`` are the times at which the observed one went on."""

    path: Path
    process: subprocess.Popen[str]
    begun: float
    log: Path

    def lines(self) -> Iterator[str]:
        """What the observed process has said: the one started first, not who speaks first."""
        name = re.escape(observed(self.path))
        log = self.log.read_text(encoding='utf-8', errors='replace')
        begins = rf'^\[INFO\] \[{name}\.py-(\d+)\]: process started'
        started = re.findall(begins, log, re.MULTILINE)
        if started:
            first = min(map(int, started))
            yield from re.findall(rf'^\[{name}\.py-{first}\] (.*)', log, re.MULTILINE)

    def count(self) -> int:
        return sum(line.startswith('goes on') for line in self.lines())


def observed(path: Path) -> str:
    """The program whose first process shows whether the system goes on."""
    found = _OBSERVED.search(path.read_text(encoding='utf-8'))
    assert found is not None, path
    return found[1]


def launch_files() -> list[Path]:
    return sorted(path for path in (SECOND / 'launch').iterdir() if path.is_file())


def install(python: str, prefix: Path) -> None:
    """What colcon would install of the package, as ament finds it."""
    name = SECOND.name
    index = prefix / 'share' / 'ament_index' / 'resource_index' / 'packages'
    index.mkdir(parents=True)
    (index / name).touch()
    for folder in ('launch', 'config'):
        shutil.copytree(SECOND / folder, prefix / 'share' / name / folder)
    shutil.copy(SECOND / 'package.xml', prefix / 'share' / name)
    programs = prefix / 'lib' / name
    programs.mkdir(parents=True)
    for file in (SECOND / 'programs').iterdir():
        text = file.read_text(encoding='utf-8')
        (programs / file.name).write_text(f'#!{python}\n{text}', encoding='utf-8')
        (programs / file.name).chmod(0o755)


def start(path: Path, python: str, sources: Path, prefix: Path, domain: int) -> Running:
    log = prefix / f'{path.name}.log'
    env = {
        **os.environ,
        'PYTHONPATH': str(sources),
        'PYTHONUNBUFFERED': '1',
        'AMENT_PREFIX_PATH': f'{prefix}:{sources}',
        'OVERRIDE_LAUNCH_PROCESS_OUTPUT': 'screen',
        'ROS_LOG_DIR': str(prefix / 'log'),
        'ROS_DOMAIN_ID': str(domain),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
    }
    installed = prefix / 'share' / SECOND.name / 'launch' / path.name
    process = subprocess.Popen(
        [python, '-c', LAUNCH, str(installed)],
        env=env,
        stdout=log.open('w'),
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
        start_new_session=True,
    )
    return Running(path, process, time.monotonic(), log)


def stop(running: Running) -> None:
    """Its whole process group: some hang so that no signal ends them but this one."""
    os.killpg(running.process.pid, signal.SIGKILL)
    running.process.wait()


def observe(group: Sequence[Running]) -> Iterator[tuple[Path, str]]:
    """Wait, and say of each whether its observed process stands still."""
    time.sleep(SECONDS - QUIET_S)
    before = [each.count() for each in group]
    time.sleep(QUIET_S)
    for each, count in zip(group, before, strict=True):
        asked = any(line.startswith('asks') for line in each.lines())
        stands = 'stands still' if asked else 'never asked'
        gone = each.count()
        yield each.path, f'{"goes on" if gone > count else stands} ({gone} rounds)'
        stop(each)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--python', required=True, help='an interpreter with rclpy')
    parser.add_argument('--sources', type=Path, required=True, help='launch and what it imports')
    parser.add_argument('--together', type=int, default=4, help='systems that run at a time')
    parser.add_argument('--domain', type=int, default=1, help='the first ROS domain of these')
    parser.add_argument('only', nargs='*', help='parts of names of launch files')
    args = parser.parse_args()
    paths = [p for p in launch_files() if not args.only or any(o in p.name for o in args.only)]
    wrong = 0
    with tempfile.TemporaryDirectory(prefix='ros2cc-launched-') as folder:
        prefix = Path(folder)
        python = str(Path(args.python).absolute())
        install(python, prefix / 'prefix')
        for at in range(0, len(paths), args.together):
            chosen = enumerate(paths[at : at + args.together], args.domain)
            group = [start(path, python, args.sources, prefix / 'prefix', n) for n, path in chosen]
            for path, what in observe(group):
                is_wrong = what.startswith('goes on') != ('_good.' in path.name)
                wrong += is_wrong
                print(f'{path.name:40} {what}{"   NOT AS NAMED" if is_wrong else ""}', flush=True)
                if is_wrong:
                    print((prefix / 'prefix' / f'{path.name}.log').read_text()[-1500:])
    print(f'{len(paths)} systems, {wrong} not as named')
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
