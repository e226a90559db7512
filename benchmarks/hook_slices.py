"""
The load of ``hook_load.py`` with the hook put on and taken off again, in slices of one run.

Arguments: single or multi, seconds. A slice without the hook, one with it, one with watchdog and
flight recorder, and one with a trace follow each other, in another order each time; so whatever
else slows the machine down meets all alike. Prints one line of JSON: CPU time per callback of each
slice in microseconds, that of the hook's own thread included, and the latency of messages. Needs
rclpy and this package.
"""

from __future__ import annotations

import json
import os
import statistics
import sys
import tempfile
import threading
import time
from pathlib import Path

import rclpy.executors
from hook_load import WARM_UP_S, Load, cpu_s, executor_for, keep_to_one_core
from rclpy.executors import Executor

from ros2cc_extract.extract.live.hook.steps import trace_submits
from ros2cc_extract.extract.live.hook.wrapping import Hook

SLICE_S = 0.5
WATCH_S = 5.0
# After the hook is put on or off, the interpreter adapts its code to the new methods.
SETTLE_S = 0.05
# Of 1000 in half a second; discovery may still be under way.
FEWEST_CALLBACKS = 200


class Switch:
    """One way of running: a hook that can be put on and off; none without a folder for it."""

    def __init__(
        self,
        executor: Executor,
        folder: Path | None,
        *,
        traced: bool = False,
        limit_s: float | None = None,
    ) -> None:
        self._pool = getattr(executor, '_executor', None) if traced else None
        self._hook = Hook(str(folder), traced=traced, limit_s=limit_s) if folder else None
        if self._hook is not None:
            # As where the hook comes first: the executor of the load is the only one.
            self._hook.recorder.sees_every_executor = True
            for node in executor.get_nodes():
                self._hook.recorder.note_added(executor, node)
            self._hook.writer.start()
            self._executor = executor

    def put_on(self) -> None:
        if self._hook is not None:
            self._hook.wrap(rclpy.executors)
            if self._pool is not None:
                trace_submits(self._hook.recorder, self._executor)

    def take_off(self) -> None:
        if self._hook is not None:
            self._hook.unwrap()
            if self._pool is not None:
                del self._pool.submit

    def stop(self) -> None:
        if self._hook is not None:
            self._hook.writer.finish()

    def settle_accounts(self) -> None:
        """Do now what the hook's thread has still to do for the slice that ends."""
        if self._hook is not None:
            self._hook.writer.take_events()


def measure_slice(way: Switch, load: Load) -> dict[str, float] | None:
    """Give CPU and latency of a slice; ``None`` if too little happened in it to tell."""
    way.put_on()
    time.sleep(SETTLE_S)
    load.latencies_ns.clear()
    received, cpu = load.received, cpu_s()
    time.sleep(SLICE_S)
    callbacks = 2 * (load.received - received)
    latencies = sorted(load.latencies_ns)
    way.settle_accounts()
    spent = cpu_s() - cpu
    way.take_off()
    if callbacks < FEWEST_CALLBACKS:
        return None
    return {
        'cpu_us_per_callback': spent / callbacks * 1e6,
        'latency_median_us': statistics.median(latencies) / 1e3,
        'latency_p99_us': latencies[len(latencies) * 99 // 100] / 1e3,
    }


def main() -> None:
    kind, seconds = sys.argv[1], float(sys.argv[2])
    keep_to_one_core()
    rclpy.init()
    load = Load()
    executor = executor_for(kind)
    executor.add_node(load)
    threading.Thread(target=executor.spin, daemon=True).start()
    time.sleep(WARM_UP_S)
    with tempfile.TemporaryDirectory() as folder:
        for name in ('spec', 'watch', 'trace'):
            Path(folder, name).mkdir()
        ways = {
            'without': Switch(executor, None),
            'spec': Switch(executor, Path(folder, 'spec')),
            'watch': Switch(executor, Path(folder, 'watch'), limit_s=WATCH_S),
            'trace': Switch(executor, Path(folder, 'trace'), traced=True),
        }
        results: dict[str, list[dict[str, float]]] = {name: [] for name in ways}
        names = list(ways)
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            slices = {name: measure_slice(ways[name], load) for name in names}
            for name, measured in slices.items():
                if measured is not None and None not in slices.values():
                    results[name].append(measured)
            names = names[1:] + names[:1]
        for way in ways.values():
            way.stop()
        print(json.dumps(results), flush=True)
    os._exit(0)


if __name__ == '__main__':
    main()
