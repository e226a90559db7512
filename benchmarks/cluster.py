"""
A sweep of many points on Dask workers: what a second worker is worth, and that nothing differs.

``python -m benchmarks.cluster [--threads 100] [--cycles 4]`` in the checkout, with the extra
dask: on this machine alone, on one worker, on two, and on two of which one is killed.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ros2cc_extract.extract.static.api import scan
from ros2cc_extract.jobs.dask_cluster import cluster_at
from ros2cc_extract.jobs.pools import Pool, Processes
from ros2cc_extract.jobs.process_pool import usable_cores
from ros2cc_extract.report.machine.json_report import to_text, verification_data
from ros2cc_extract.spec.close import Policy
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.sweep import Point, points, run_sweep
from tests.support.dask_cluster import dask_cluster

NODE = Path(__file__).parents[1] / 'launch_free_examples' / 'two_groups' / 'node.py'


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--threads', type=int, default=100)
    parser.add_argument('--cycles', type=int, default=4)
    args = parser.parse_args()
    (unit,) = scan([NODE]).units
    settings = points(range(1, args.threads + 1), range(1, args.cycles + 1))
    seconds, expected = timed(unit, settings, Processes(usable_cores()))
    print(f'{len(settings)} jobs: {seconds:.1f} s on {usable_cores()} cores of this machine')
    one, told = on_workers(unit, settings, 1)
    print(f'one worker: {one:.1f} s, equal: {told == expected}')
    two, told = on_workers(unit, settings, 2)
    print(f'two workers: {two:.1f} s, {one / two:.2f} times as fast, equal: {told == expected}')
    killed, told = on_workers(unit, settings, 2, kills=True)
    print(f'one of two killed half-way: {killed:.1f} s, equal: {told == expected}')


def on_workers(
    unit: Spec, settings: tuple[Point, ...], workers: int, kills: bool = False
) -> tuple[float, str]:
    with (
        tempfile.TemporaryDirectory() as folder,
        dask_cluster(Path(folder), workers) as cluster,
    ):
        pool = cluster_at(cluster.address)
        timed(unit, settings[:workers], pool)  # what is imported and built once

        def look(done: int) -> None:
            if kills and done == len(settings) // 2:
                cluster.kill(0)

        return timed(unit, settings, pool, look)


def timed(
    unit: Spec,
    settings: tuple[Point, ...],
    pool: Pool,
    look: Callable[[int], None] = lambda done: None,
) -> tuple[float, str]:
    """How long it takes, and the report without what differs from run to run."""
    began = time.perf_counter()
    swept = run_sweep(unit, Policy(), Options(), settings, pool, look)
    seconds = time.perf_counter() - began
    return seconds, to_text([without_cost(verification_data(v)) for v in swept.verifications])


def without_cost(data: dict[str, Any]) -> dict[str, Any]:
    queries = [query | {'seconds': 0} for query in data['queries']]
    return data | {'seconds': 0, 'peak_mb': 0, 'queries': queries}


if __name__ == '__main__':
    main()
