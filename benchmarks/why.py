"""
What ``why`` costs a healthy process: how long its threads stand still, and the time to the answer.

    python benchmarks/why.py               20 times each, without the hook and with it, 5 minutes
    python benchmarks/why.py --times 5

The interpreter with rclpy is that of ``ROS2CC_RCLPY_PYTHON``, else this one. A busy node has a
thread that ticks each millisecond (``why_load.py``); shown are its longest gaps while ``why``
looks at it, while ``why`` looks at another process, which takes the same processors, and while
nobody does. The gaps in time of the process's own processors grow less on a busy machine, and say
how long others of its threads kept the lock of the interpreter; whom the kernel stops shows in the
others only.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import statistics
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from ros2cc_extract.extract.live.environment import hooked_environment

HERE = Path(__file__).resolve().parent
PYTHON = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
GAP = struct.Struct('ddd')
WARM_UP_S, BETWEEN_S, NOBODY_S = 4.0, 0.5, 0.8
BAR_MS = 20.0


@contextlib.contextmanager
def running(folder: Path, *, hooked: bool) -> Iterator[tuple[int, Path]]:
    """A load, and the file of its gaps."""
    folder.mkdir(parents=True)
    gaps = folder / 'gaps'
    environment = {**os.environ, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    if hooked:
        environment = hooked_environment(environment, folder)
    command = [PYTHON, str(HERE / 'why_load.py'), str(gaps)]
    load = subprocess.Popen(command, env=environment)
    try:
        time.sleep(WARM_UP_S)
        yield load.pid, gaps
    finally:
        load.kill()
        load.wait()


def ask_why(pid: int) -> None:
    command = [sys.executable, '-m', 'ros2cc_extract.cli.main', 'why', str(pid)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True)
    # A busy machine may not let it in in time, which it says itself.
    if 'healthy' not in done.stdout and 'busy' not in done.stdout:
        print(f'  not healthy: {done.stdout.partition(chr(10))[0]}')


def longest(gaps: Path, work: Callable[[], object]) -> tuple[float, float, float]:
    """
    The longest gap while something is done, by the clock and of processors; how long that took.

    In milliseconds, and in seconds.
    """
    begun = time.monotonic()
    work()
    ended = time.monotonic()
    time.sleep(0.1)
    data = gaps.read_bytes()
    rows = GAP.iter_unpack(data[: len(data) // GAP.size * GAP.size])
    found = [(1e3 * gap, 1e3 * used) for at, gap, used in rows if begun < at and at - gap < ended]
    worst = max((gap for gap, _ in found), default=0.0)
    return worst, max((used for _, used in found), default=0.0), ended - begun


def told(name: str, values: Sequence[float], unit: str) -> str:
    ordered = sorted(values)
    shown = ' '.join(f'{each:.1f}' if unit == 'ms' else f'{each:.2f}' for each in ordered)
    middle, worst = statistics.median(ordered), ordered[-1]
    return f'{name:<36} median {middle:6.2f}, worst {worst:6.2f} {unit}: {shown}'


def measure(folder: Path, times: int, *, hooked: bool) -> float:
    print('with the hook' if hooked else 'without the hook')
    with (
        running(folder / 'asked', hooked=hooked) as (pid, gaps),
        running(folder / 'beside', hooked=False) as (other, _),
    ):
        ways: dict[str, Callable[[], object]] = {
            'nobody asks': lambda: time.sleep(NOBODY_S),
            'another one is asked': lambda: ask_why(other),
            'it is asked': lambda: ask_why(pid),
        }
        found: dict[str, list[tuple[float, float, float]]] = {way: [] for way in ways}
        for _ in range(times):
            for way, work in ways.items():
                found[way].append(longest(gaps, work))
                time.sleep(BETWEEN_S)
    for way, rows in found.items():
        print('  ' + told(f'{way}, by the clock', [gap for gap, _, _ in rows], 'ms'))
        print('  ' + told(f'{way}, processors', [used for _, used, _ in rows], 'ms'))
    print('  ' + told('time to the answer', [took for _, _, took in found['it is asked']], 's'))
    return max(used for _, used, _ in found['it is asked'])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--times', type=int, default=20)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        worst = [
            measure(Path(name, str(hooked)), args.times, hooked=hooked) for hooked in (False, True)
        ]
    return int(max(worst) > BAR_MS)


if __name__ == '__main__':
    sys.exit(main())
