"""
What the live hook costs: paired runs of one load without it, with it, and with a trace.

    python benchmarks/hook.py [--seconds 10] [--rounds 5] [--kinds single,multi]

The interpreter with rclpy is that of ``ROS2CC_RCLPY_PYTHON``, else this one. Runs of a round
follow each other directly; the table gives the median over the rounds, and for the cost the
median of the differences within a round.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from ros2cc_extract.extract.live.environment import hooked_environment

LOAD = Path(__file__).with_name('hook_load.py')
WAYS = ('without', 'spec', 'trace')
Result = Mapping[str, float]


def run_load(kind: str, seconds: float, way: str) -> Result:
    environment = {
        **os.environ,
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'ROS_DOMAIN_ID': os.environ.get('ROS_DOMAIN_ID', str(os.getpid() % 100 + 1)),
    }
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    with tempfile.TemporaryDirectory() as folder:
        if way != 'without':
            environment = hooked_environment(environment, Path(folder), traced=way == 'trace')
        done = subprocess.run(
            [python, str(LOAD), kind, str(seconds)],
            env=environment,
            stdout=subprocess.PIPE,
            check=True,
            timeout=seconds + 60,
        )
    return json.loads(done.stdout)


def measure(kind: str, seconds: float, rounds: int) -> dict[str, list[Result]]:
    results: dict[str, list[Result]] = {way: [] for way in WAYS}
    for number in range(rounds):
        # Another order in each round, so that no way always follows the same one.
        for way in WAYS[number % 3 :] + WAYS[: number % 3]:
            results[way].append(run_load(kind, seconds, way))
    return results


def print_table(kind: str, results: Mapping[str, Sequence[Result]]) -> None:
    names = list(results['without'][0])
    print(f'\n{kind}-threaded' + ''.join(f'{name:>22}' for name in names) + f'{"cost":>9}')
    for way in WAYS:
        medians = [statistics.median(each[name] for each in results[way]) for name in names]
        shares = [
            with_hook['cpu_us_per_callback'] / without['cpu_us_per_callback'] - 1
            for with_hook, without in zip(results[way], results['without'], strict=True)
        ]
        cells = ''.join(f'{median:22.1f}' for median in medians)
        print(f'{way:<{len(kind) + 9}}{cells}{statistics.median(shares):+9.1%}')


def print_event_cost() -> None:
    """Time the wrapper of a group's two methods alone, against the bare methods."""
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    source = Path(__file__).resolve().parents[1]
    hooked = subprocess.run(
        [python, '-c', _EVENT_COST],
        env={**os.environ, 'PYTHONPATH': str(source)},
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    print('\ncost of one event (begin or end of a callback):', hooked.stdout.strip())


_EVENT_COST = """
import tempfile, timeit
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup as Group
class Entity:
    callback = None
group, entity = Group(), Entity()
group.add_entity(entity)
def both():
    group.beginning_execution(entity)
    group.ending_execution(entity)
bare = min(timeit.repeat(both, number=20000, repeat=7)) / 40000
from ros2cc_extract.extract.live.hook import Hook
import rclpy.executors
hook = Hook(tempfile.mkdtemp())
hook.wrap(rclpy.executors)
hooked = min(timeit.repeat(both, number=20000, repeat=7)) / 40000
hook.unwrap()
print(f'{bare * 1e6:.2f} us without, {hooked * 1e6:.2f} us with the hook')
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--seconds', type=float, default=10.0)
    parser.add_argument('--rounds', type=int, default=5)
    parser.add_argument('--kinds', default='single,multi')
    options = parser.parse_args()
    print_event_cost()
    for kind in options.kinds.split(','):
        print_table(kind, measure(kind, options.seconds, options.rounds))


if __name__ == '__main__':
    main()
