"""
The conformance suite: random node programs on real executors, each trace a path of its model.

``python -m tests.conformance.suite --python PYTHON --programs 1000`` runs programs in processes
of some dozens and says how many of them and of their events conform, and which seeds do not.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from pathlib import Path

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Trace, read_traces
from ros2cc_extract.conform.unit import Comparison
from ros2cc_extract.extract.live.recordings.output_files import write_traces
from ros2cc_extract.extract.live.run import record
from ros2cc_extract.spec.releases.table import EVENTS_EXECUTOR
from tests.conformance.checking import Ran, compare_in_time, read_ran
from tests.conformance.programs import EVENTS, draw
from tests.support.domains import free_domain

DRIVER = Path(__file__).with_name('driver.py')
CHUNK = 40


@dataclass
class Tally:
    """What came of many programs."""

    outcomes: Counter[Outcome] = field(default_factory=Counter)
    events: int = 0
    reordered: int = 0
    told: int = 0
    delayed: int = 0
    run_s: float = 0.0
    check_s: float = 0.0
    failed: list[int] = field(default_factory=list)

    def add(self, ran: Ran, comparison: Comparison, was_delayed: bool) -> None:
        """Count one program."""
        answer = comparison.answer
        self.outcomes[answer.outcome] += 1
        self.events += len(comparison.observations)
        self.reordered += answer.reordered_ns > 0
        self.told += bool(ran.arrivals)
        self.delayed += was_delayed
        if answer.outcome is not Outcome.CONFORMS:
            self.failed.append(ran.seed)

    def join(self, other: Tally) -> None:
        """Count what another tally has counted."""
        for each in fields(self):
            mine, theirs = getattr(self, each.name), getattr(other, each.name)
            setattr(self, each.name, mine + theirs)

    def __str__(self) -> str:
        told = ', '.join(f'{self.outcomes[o]} {o.value}' for o in Outcome)
        return (
            f'{self.outcomes.total()} programs: {told}; {self.events} events, '
            f'{self.reordered} traces with threads put in order; '
            f'of {self.told} with arrivals {self.delayed} were delayed; '
            f'run {self.run_s:.0f} s, checked {self.check_s:.0f} s; failed {self.failed}'
        )


def run_programs(
    python: str, seeds: Sequence[int], environment: dict[str, str], folder: Path
) -> tuple[Trace, list[Ran]]:
    """Run programs in one process and give its trace."""
    out, trace_file = folder / 'ran.jsonl', folder / 'trace.jsonl'
    command = [python, str(DRIVER), str(out), *map(str, seeds)]
    recordings = folder / 'recordings'
    recordings.mkdir()
    recorded = record(command, environment, sys.stderr, recordings, traced=True)
    assert recorded.status == 0, f'the driver ended with {recorded.status}'
    write_traces(recorded.traces, trace_file, sys.stderr)
    (trace,) = read_traces(trace_file)
    return trace, read_ran(out)


@dataclass(frozen=True)
class Release:
    """A release that stands in a folder of its own, before the one that PYTHON has."""

    version: str
    folder: Path

    def over(self, environment: dict[str, str]) -> dict[str, str]:
        """The environment with this release first."""
        return {**environment, 'PYTHONPATH': str(self.folder)}


def runnable(seeds: Sequence[int], built: Release | None) -> list[int]:
    """Leave out programs for an executor that the release has not."""
    if built is None or EVENTS_EXECUTOR.holds(built.version):
        return list(seeds)
    return [seed for seed in seeds if draw(seed).executor != EVENTS]


@contextmanager
def own_environment() -> Iterator[dict[str, str]]:
    """Give an environment with a domain of its own, and nothing beyond this machine."""
    with free_domain() as number:
        yield {
            **os.environ,
            'ROS_DOMAIN_ID': str(number),
            'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        }


@dataclass(frozen=True)
class Chunk:
    """Programs that run in one process, and the folder for its trace if one fails."""

    python: str
    seeds: range
    keep: Path | None
    built: Release | None

    def run(self) -> Tally:
        """Run the programs, and compare what they did."""
        tally = Tally()
        with tempfile.TemporaryDirectory(prefix='ros2cc-conformance-') as folder:
            begun = time.monotonic()
            with own_environment() as environment:
                given = environment if self.built is None else self.built.over(environment)
                seeds = runnable(self.seeds, self.built)
                trace, ran = run_programs(self.python, seeds, given, Path(folder))
            assert self.built is None or trace.rclpy == self.built.version, trace.rclpy
            tally.run_s = time.monotonic() - begun
            begun = time.monotonic()
            for each in ran:
                tally.add(each, *compare_in_time(trace, each))
            tally.check_s = time.monotonic() - begun
            if self.keep is not None and tally.failed:
                for name in ('ran.jsonl', 'trace.jsonl'):
                    shutil.copy(Path(folder) / name, self.keep / f'{self.seeds.start}_{name}')
        return tally


def run_suite(
    python: str,
    first: int,
    programs: int,
    keep: Path | None,
    built: Release | None = None,
    at_once: int = 1,
) -> Tally:
    """Run programs in chunks, so many at once, compare them, and print what fails."""
    tally, over = Tally(), first + programs
    seeds = (range(start, min(start + CHUNK, over)) for start in range(first, over, CHUNK))
    chunks = [Chunk(python, each, keep, built) for each in seeds]
    with ProcessPoolExecutor(at_once) as pool:
        for done in pool.map(Chunk.run, chunks):
            tally.join(done)
            print(tally, flush=True)
    return tally


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[1] if __doc__ else '')
    parser.add_argument('--python', default=sys.executable, help='an interpreter with rclpy')
    parser.add_argument('--first', type=int, default=0, help='first seed')
    parser.add_argument('--programs', type=int, default=1000)
    parser.add_argument('--keep', type=Path, help='folder for the traces of failing chunks')
    parser.add_argument('--release', help='the one that --built holds, such as 7.1.11')
    parser.add_argument('--built', type=Path, metavar='FOLDER', help='with rclpy, see releases.py')
    parser.add_argument('--at-once', type=int, default=1, help='processes; programs mostly wait')
    args = parser.parse_args()
    if args.keep is not None:
        args.keep.mkdir(parents=True, exist_ok=True)
    built = Release(args.release, args.built.resolve()) if args.built is not None else None
    tally = run_suite(args.python, args.first, args.programs, args.keep, built, args.at_once)
    return 0 if set(tally.outcomes) <= {Outcome.CONFORMS} else 1


if __name__ == '__main__':
    sys.exit(main())
