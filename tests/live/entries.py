"""
Enters a process that is hard to enter, again and again: none of its threads stands afterwards.

``python -m tests.live.entries PYTHON COUNT`` for an interpreter with rclpy: ``make enter``.
"""

from __future__ import annotations

import os
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from ros2cc_extract.errors import Ros2ccError
from ros2cc_extract.extract.live.injection import Injector, inject, injectors
from tests.support.domains import free_domain

HOT = Path(__file__).with_name('programs') / 'hot.py'
THREADS = 6
# The machine may be busy: a thread that has not come round by then stands.
STANDS_AFTER_S = 30.0
# What the process has of its own, reported by itself: names in __main__ and threads of Python.
SCRIPT = """
import sys
def tell():
    import threading
    names = len(vars(sys.modules['__main__']))
    with open({heard!r}, 'a') as stream:
        stream.write(f'{{names}} {{len(threading._active)}}\\n')
tell()
"""


@dataclass
class Outcome:
    """
    :param frozen: threads that made no round after an entry, by their place in the program.
    :param told: what the process said of itself at each entry.
    :param left: what an entry left behind: parts of the library, stopped threads.
    """

    entered: int = 0
    refused: list[str] = field(default_factory=list)
    frozen: list[int] = field(default_factory=list)
    told: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    times: list[float] = field(default_factory=list)


@contextmanager
def hot_process(python: str, folder: Path) -> Iterator[tuple[subprocess.Popen[bytes], Path]]:
    rounds = folder / 'rounds'
    rounds.write_bytes(bytes(8 * THREADS))
    with free_domain() as domain:
        env = {
            **os.environ,
            'ROS_DOMAIN_ID': str(domain),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }
        command = [python, str(HOT), str(rounds)]
        process = subprocess.Popen(command, env=env, stdout=subprocess.PIPE)
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == b'hot\n'
            yield process, rounds
        finally:
            process.kill()
            process.wait()


def enter_often(python: str, count: int, ways: Sequence[Injector] = ()) -> Outcome:
    """Enter one process ``count`` times, or until a thread stands."""
    outcome = Outcome()
    with tempfile.TemporaryDirectory() as name:
        script, heard = Path(name, 'hear.py'), Path(name, 'heard')
        script.write_text(SCRIPT.format(heard=str(heard)))
        with hot_process(python, Path(name)) as (process, rounds):
            while outcome.entered + len(outcome.refused) < count and not outcome.frozen:
                begun = time.monotonic()
                try:
                    inject(process.pid, script, ways or injectors())
                except Ros2ccError as error:
                    outcome.refused.append(str(error))
                else:
                    outcome.entered += 1
                    outcome.times.append(time.monotonic() - begun)
                outcome.frozen = standing(rounds)
            if not outcome.frozen:
                _await_lines(heard, outcome.entered)
                time.sleep(0.1)  # the last thread of ours ends
                outcome.left = _left_in(process.pid)
        outcome.told = heard.read_text().splitlines() if heard.exists() else []
    return outcome


def standing(rounds: Path) -> list[int]:
    """Give the threads that do not come round any more."""
    before = struct.unpack(f'{THREADS}q', rounds.read_bytes())
    deadline = time.monotonic() + STANDS_AFTER_S
    while time.monotonic() < deadline:
        now = struct.unpack(f'{THREADS}q', rounds.read_bytes())
        found = [each for each in range(THREADS) if now[each] <= before[each]]
        if not found:
            return []
        time.sleep(0.005)
    return found


def _await_lines(heard: Path, count: int) -> None:
    deadline = time.monotonic() + STANDS_AFTER_S
    while time.monotonic() < deadline:
        if heard.exists() and len(heard.read_text().splitlines()) >= count:
            return
        time.sleep(0.05)


def _left_in(pid: int) -> list[str]:
    maps = Path(f'/proc/{pid}/maps').read_text().splitlines()
    left = [line for line in maps if 'enter' in line.rpartition('/')[2]]
    for task in Path(f'/proc/{pid}/task').iterdir():
        status = (task / 'status').read_text()
        left += [f'{task.name} is traced'] * ('TracerPid:\t0' not in status)
        left += [f'{task.name} is stopped'] * ('State:\tT' in status)
        left += [f'{task.name} is ours'] * ('Name:\tros2cc' in status)
    return left


def main(python: str, count: int) -> int:
    outcome = enter_often(python, count)
    times = sorted(outcome.times)
    print(
        f'{outcome.entered} entries, {len(outcome.refused)} refused, stands: {outcome.frozen}, '
        f'left behind: {outcome.left}, told of itself: {sorted(set(outcome.told))}; '
        f'median {times[len(times) // 2] * 1000:.0f} ms, worst {times[-1] * 1000:.0f} ms'
    )
    for each in sorted(set(outcome.refused)):
        print(each)
    is_good = not outcome.frozen and not outcome.left and len(outcome.told) == outcome.entered
    return 0 if is_good and outcome.entered else 1


if __name__ == '__main__':
    sys.exit(main(sys.argv[1], int(sys.argv[2])))
