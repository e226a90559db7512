"""
What the live hook costs: one load without it, with it, with the flight recorder, and with a trace.

    python benchmarks/hook.py                     CPU time and latency, 2.5 minutes
    python benchmarks/hook.py --processes 5       the same from processes of their own, 4 minutes
    python benchmarks/hook.py --memory 10         memory over ten minutes; twice that for each kind

The interpreter with rclpy is that of ``ROS2CC_RCLPY_PYTHON``, else this one. The first form puts
the hook on and off in slices of half a second within one process; what it costs is the median over
all slices of the ratio to the slice without the hook beside it, with the interval that holds the
true median in 95 of 100 measurements. Processes of their own are as a user has them, but differ
among themselves by more than the hook costs.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from ros2cc_extract.extract.live.environment import hooked_environment

HERE = Path(__file__).resolve().parent
WAYS = ('without', 'spec', 'watch', 'trace')
WATCH_S = 5.0
COSTS = {
    'cpu_us_per_callback': 'cost of CPU',
    'latency_median_us': 'of latency',
    'latency_p99_us': 'of its p99',
}
PYTHON = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
SAMPLE_EVERY_S = 5.0
# Of the minutes of a measurement; in the first fifth the allocator takes what it needs.
SHOWN_SHARES = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
WARM_UP_S = 5.0
Result = Mapping[str, float]


def environment_of(way: str, folder: str) -> dict[str, str]:
    # A domain for each way: side by side they would hear each other's messages.
    domain = int(os.environ.get('ROS_DOMAIN_ID', os.getpid() % 90 + 1)) + WAYS.index(way)
    environment = {
        **os.environ,
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'ROS_DOMAIN_ID': str(domain),
    }
    if way == 'without':
        return environment
    limit_s = WATCH_S if way == 'watch' else None
    return hooked_environment(environment, Path(folder), traced=way == 'trace', limit_s=limit_s)


def measure_slices(kind: str, seconds: float) -> dict[str, list[Result]]:
    environment = environment_of('without', '')
    done = subprocess.run(
        [PYTHON, str(HERE / 'hook_slices.py'), kind, str(seconds)],
        env={**environment, 'PYTHONPATH': str(HERE.parent)},
        stdout=subprocess.PIPE,
        check=True,
        timeout=3 * seconds + 60,
    )
    results: dict[str, list[Result]] = json.loads(done.stdout)
    return results


def measure_processes(kind: str, seconds: float, rounds: int) -> dict[str, list[Result]]:
    results: dict[str, list[Result]] = {way: [] for way in WAYS}
    for number in range(rounds):
        # Another order in each round, so that no way always follows the same one.
        turn = number % len(WAYS)
        for way in WAYS[turn:] + WAYS[:turn]:
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(
                    [PYTHON, str(HERE / 'hook_load.py'), kind, str(seconds)],
                    env=environment_of(way, folder),
                    stdout=subprocess.PIPE,
                    check=True,
                    timeout=seconds + 60,
                )
            results[way].append(json.loads(done.stdout))
    return results


def print_table(kind: str, results: Mapping[str, Sequence[Result]]) -> None:
    names = list(results['without'][0])
    heads = ''.join(f'{name:>22}' for name in names)
    costs = ''.join(f'{what:>28}' for what in COSTS.values())
    print(f'\n{kind}-threaded{heads}{costs}   of {len(results["spec"])} pairs')
    for way in WAYS:
        medians = [statistics.median(each[name] for each in results[way]) for name in names]
        cells = ''.join(f'{median:22.1f}' for median in medians)
        print(f'{way:<{len(kind) + 9}}{cells}{"".join(changes(results, way))}')


def changes(results: Mapping[str, Sequence[Result]], way: str) -> Iterator[str]:
    """Tell the median of what each slice costs beside its neighbour, and how well it is known."""
    pairs = list(zip(results[way], results['without'], strict=True))
    for name in COSTS:
        costs = [hooked[name] / bare[name] - 1 for hooked, bare in pairs]
        low, high = median_interval(costs)
        yield f'{statistics.median(costs):+10.1%} ({low:+.1%} to {high:+.1%})'.rjust(28)


def median_interval(values: Sequence[float]) -> tuple[float, float]:
    """Give what holds the median in 95 of 100 samples like this one, whatever the distribution."""
    ordered, count = sorted(values), len(values)
    ranks = 1.96 * count**0.5 / 2
    return (
        ordered[max(0, math.floor(count / 2 - ranks))],
        ordered[min(count - 1, math.ceil(count / 2 + ranks))],
    )


def print_event_cost() -> None:
    """Time the wrapper of a group's two methods alone, against the bare methods."""
    hooked = subprocess.run(
        [PYTHON, '-c', _EVENT_COST],
        env={**os.environ, 'PYTHONPATH': str(HERE.parent)},
        stdout=subprocess.PIPE,
        check=True,
        text=True,
    )
    print('cost of one event (begin or end of a callback):', hooked.stdout.strip())


_EVENT_COST = """
import tempfile, time, timeit
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup as Group
class Entity:
    callback = None
group, entity = Group(), Entity()
group.add_entity(entity)
def both():
    group.beginning_execution(entity)
    group.ending_execution(entity)
bare = min(timeit.repeat(both, number=2000, repeat=70)) / 4000
from ros2cc_extract.extract.live.recorder.events import SIZE
from ros2cc_extract.extract.live.hook.wrapping import Hook
import rclpy.executors
hook = Hook(tempfile.mkdtemp())
hook.wrap(rclpy.executors)
# The hook's own thread would have taken them.
empty = hook.recorder.journal.clear
hooked = min(timeit.repeat(both, empty, number=2000, repeat=70)) / 4000
empty()
for _ in range(500):
    both()
begun = time.perf_counter()
taken = len(hook.recorder.take_events()) / SIZE
take = (time.perf_counter() - begun) / taken
hook.unwrap()
print(f'{bare * 1e6:.2f} us without, {hooked * 1e6:.2f} us with the hook, '
      f'{take * 1e6:.2f} us later in its own thread')
"""


def measure_memory(kind: str, minutes: float) -> None:
    """Print how the memory of a process of ``minutes`` grows, each way on a core of its own."""
    heads = ''.join(f'{share:>9.0%}' for share in SHOWN_SHARES)
    print(f'\n{kind}-threaded     callbacks/s   RSS in KB at{heads} of {minutes:g} min', end='')
    print(f'    slope after {SHOWN_SHARES[1]:.0%}')
    cores = sorted(os.sched_getaffinity(0))
    ways = list(WAYS)
    while ways:
        measure_memory_of(ways[: len(cores)], cores, kind, minutes)
        ways = ways[len(cores) :]


def measure_memory_of(
    ways: Sequence[str], cores: Sequence[int], kind: str, minutes: float
) -> None:
    samples: dict[str, list[tuple[float, float]]] = {way: [] for way in ways}
    with contextlib.ExitStack() as stack:
        loads = {
            way: stack.enter_context(_running(kind, 60 * minutes + WARM_UP_S, way, core))
            for way, core in zip(ways, cores, strict=False)
        }
        # What it needs at its start and at its end is no growth.
        begun = time.monotonic() + WARM_UP_S
        time.sleep(WARM_UP_S)
        while (minute := (time.monotonic() - begun) / 60) < minutes:
            for way, load in loads.items():
                samples[way].append((minute, rss_kb(load.pid)))
            time.sleep(SAMPLE_EVERY_S)
        results = {way: json.loads(load.communicate()[0]) for way, load in loads.items()}
    for way, all_of_way in samples.items():
        settled = [each for each in all_of_way if each[0] >= SHOWN_SHARES[1] * minutes]
        slope = statistics.linear_regression(*zip(*settled, strict=True)).slope
        shown = (all_of_way[round(share * (len(all_of_way) - 1))][1] for share in SHOWN_SHARES)
        cells = ''.join(f'{kb:9.0f}' for kb in shown)
        rate = results[way]['callbacks_per_s']
        print(f'{way:<17}{rate:13.0f}{"":15}{cells}{slope:+26.2f} KB per minute', flush=True)


@contextlib.contextmanager
def _running(kind: str, seconds: float, way: str, core: int) -> Iterator[subprocess.Popen[bytes]]:
    with tempfile.TemporaryDirectory() as folder:
        load = subprocess.Popen(
            [PYTHON, str(HERE / 'hook_load.py'), kind, str(seconds)],
            env=environment_of(way, folder),
            stdout=subprocess.PIPE,
            preexec_fn=lambda: os.sched_setaffinity(0, {core}),
        )
        try:
            yield load
        finally:
            load.kill()
            load.wait()


def rss_kb(pid: int) -> float:
    pages = int(Path(f'/proc/{pid}/statm').read_text().split()[1])
    return pages * os.sysconf('SC_PAGE_SIZE') / 1024


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument('--seconds', type=float, help='of each kind (70), or process (10)')
    parser.add_argument('--processes', type=int, metavar='ROUNDS', default=0)
    parser.add_argument('--memory', type=float, metavar='MINUTES', default=0)
    parser.add_argument('--kinds', default='single,multi')
    options = parser.parse_args()
    kinds = options.kinds.split(',')
    if options.memory:
        for kind in kinds:
            measure_memory(kind, options.memory)
        return
    print_event_cost()
    for kind in kinds:
        if options.processes:
            results = measure_processes(kind, options.seconds or 10.0, options.processes)
        else:
            results = measure_slices(kind, options.seconds or 70.0)
        print_table(kind, results)


if __name__ == '__main__':
    main()
