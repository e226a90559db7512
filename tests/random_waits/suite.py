"""
Random programs that wait: who hangs on real rclpy must not be *satisfied* in the model.

``python -m tests.random_waits.suite --python PYTHON --programs 1000`` draws, runs and judges
programs, and counts who hung, and of these who is found, undecided, or missed. With ``--record
FILE`` it only runs them; ``--judge FILE`` judges what a record has. Whom the model calls stuck
and who did not hang is run once more with random pauses.
"""

from __future__ import annotations

import argparse
import json
import math
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.deadline import Deadline
from ros2cc_extract.extract.static.api import scan_text
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.conformance.suite import own_environment
from tests.random_waits.alone import alone
from tests.random_waits.programs import program
from tests.random_waits.recorded import Ran, add, load, unfinished

WATCH = Path(__file__).with_name('watch.py')
CHUNK = 20
OPTIONS = Options(profile=Profile.RCLPY, structural=False, families=frozenset({Family.PROGRESS}))
MOST_S = 20.0
ENDS, FOUND, UNDECIDED = 'always ends', 'found', 'undecided'
_OF_VERDICT = {
    Verdict.SATISFIED: ENDS,
    Verdict.NOT_SATISFIED: FOUND,
    Verdict.UNDECIDED: UNDECIDED,
}


def judge(text: str) -> dict[str, str]:
    """For each function of a program whether the model lets it wait forever."""
    judged: dict[str, str] = {}
    options = replace(OPTIONS, limits=_limits())
    for unit in (alone(unit, text) for unit in scan_text(text).units):
        names = _functions(unit)
        for result in verify_unit(close(unit), options).results:
            if result.family == Family.PROGRESS.value:
                function = names.get(result.callbacks[0], result.callbacks[0])
                judged[function] = _worse(judged.get(function), _OF_VERDICT[result.verdict])
    return judged


def _functions(unit: Spec) -> dict[str, str]:
    everybody = (*unit.callbacks, *unit.activities)
    return {one.name: one.function.rpartition('.')[2] for one in everybody if one.function}


def _worse(one: str | None, other: str) -> str:
    return max(one or ENDS, other, key=(ENDS, UNDECIDED, FOUND).index)


@dataclass(frozen=True)
class _OfWork(Deadline):
    """
    Counts what this process works, as a busy machine is to change no verdict.

    :param until: by ``time.process_time``.
    """

    until: float

    @property
    def is_over(self) -> bool:
        return time.process_time() > self.until


def _limits() -> Limits:
    until = time.process_time() + MOST_S
    return Limits(deadline=_OfWork(math.inf, f'{MOST_S:g} s of work are over', until))


@dataclass
class Tally:
    """What came of many programs."""

    programs: int = 0
    hung: int = 0
    judged: Counter[str] = field(default_factory=Counter)
    stuck: Counter[str] = field(default_factory=Counter)
    missed: list[tuple[int, str]] = field(default_factory=list)
    disturbed: Counter[str] = field(default_factory=Counter)

    def add(self, ran: Ran) -> None:
        """Count one program that was judged."""
        judged = ran.judged or {}
        self.programs += 1
        of_program = worst(judged)
        self.judged[of_program] += 1
        stuck = dict.fromkeys((*ran.stuck, *(ran.disturbed or ())))
        self.hung += bool(ran.stuck)
        for function in stuck:
            # Of one that the model is not asked about it says nothing by itself.
            verdict = judged.get(function, of_program)
            self.stuck[verdict] += 1
            if verdict == ENDS:
                self.missed.append((ran.seed, function))
        if of_program == FOUND and not ran.stuck:
            again = 'was not run again' if ran.disturbed is None else 'did not hang'
            self.disturbed['hung under a disturbed schedule' if ran.disturbed else again] += 1

    def __str__(self) -> str:
        return (
            f'{self.programs} programs, {self.hung} hung; in the model {dict(self.judged)}; '
            f'functions that hung {dict(self.stuck)}; missed {self.missed}; '
            f'found and not hung at first {dict(self.disturbed)}'
        )


def worst(judged: Mapping[str, str]) -> str:
    """The verdict on a program: that on the function that is worst off."""
    return max(judged.values(), key=(ENDS, UNDECIDED, FOUND).index, default=ENDS)


def watch(python: str, seeds: Sequence[int], *, disturbed: bool = False) -> dict[int, list[str]]:
    """Run programs, and give for each the functions that stood still."""
    texts = {f'waiter_{seed}': program(seed) for seed in seeds}
    stuck = stuck_in_files(python, texts, disturbed=disturbed)
    return {seed: stuck[f'waiter_{seed}'] for seed in seeds if f'waiter_{seed}' in stuck}


def stuck_in_files(
    python: str, texts: Mapping[str, str], *, disturbed: bool = False
) -> dict[str, list[str]]:
    """Run programs by names, and give for each the functions that stood still."""
    with tempfile.TemporaryDirectory(prefix='ros2cc-waits-') as folder, own_environment() as env:
        files = {Path(folder) / f'{name}.py': name for name in texts}
        for file, name in files.items():
            file.write_text(texts[name], encoding='utf-8')
        out = Path(folder) / 'out.jsonl'
        env = {**env, 'WATCH_DISTURBS': '1' if disturbed else ''}
        subprocess.run([python, str(WATCH), str(out), *map(str, files)], env=env, check=True)
        rows = [json.loads(line) for line in out.read_text(encoding='utf-8').splitlines()]
        return {files[Path(row['file'])]: row['stuck'] for row in rows}


def run(record: Path, python: str, seeds: Sequence[int]) -> None:
    """Run what was not run yet, and write it down."""
    left = unfinished(seeds, load(record))
    for start in range(0, len(left), CHUNK):
        ran = watch(python, left[start : start + CHUNK])
        add(record, (Ran(seed, tuple(stuck)) for seed, stuck in sorted(ran.items())))
        print(f'{min(start + CHUNK, len(left))} of {len(left)} run', flush=True)


def judge_all(
    record: Path, seeds: Sequence[int], jobs: int = 1, elsewhere: Path | None = None
) -> None:
    """
    Ask the model of each program that was run, and write down what it says.

    :param elsewhere: what was run on another distribution: the model is the same.
    """
    known = load(record)
    told = load(elsewhere) if elsewhere is not None else {}
    left = [seed for seed in seeds if seed in known and known[seed].judged is None]
    same = [seed for seed in left if seed in told and told[seed].judged is not None]
    add(record, (replace(known[seed], judged=told[seed].judged) for seed in same))
    left = [seed for seed in left if seed not in set(same)]
    with multiprocessing.Pool(jobs, maxtasksperchild=CHUNK) as pool:
        for seed, judged in pool.imap_unordered(_judge_seed, left):
            add(record, [replace(known[seed], judged=judged)])


def _judge_seed(seed: int) -> tuple[int, dict[str, str]]:
    return seed, judge(program(seed))


def disturb(record: Path, python: str, seeds: Sequence[int]) -> None:
    """
    Run with random pauses whom the model calls stuck and who did not hang.

    What it takes may be a schedule that an idle machine does not give.
    """
    known = load(record)
    left = [
        seed
        for seed in seeds
        if seed in known
        and worst(known[seed].judged or {}) == FOUND
        and not known[seed].stuck
        and known[seed].disturbed is None
    ]
    for start in range(0, len(left), CHUNK):
        ran = watch(python, left[start : start + CHUNK], disturbed=True)
        add(record, (replace(known[s], disturbed=tuple(stuck)) for s, stuck in ran.items()))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--python', help='an interpreter with rclpy')
    parser.add_argument('--first', type=int, default=0, help='first seed')
    parser.add_argument('--programs', type=int, default=1000)
    parser.add_argument('--record', type=Path, help='what was run; it goes on where it was cut')
    parser.add_argument('--judge', type=Path, help='run nothing, judge what this record has')
    parser.add_argument('--known', type=Path, help='a record whose programs were judged before')
    parser.add_argument('--jobs', type=int, default=os.cpu_count() or 1, help='who judge at once')
    args = parser.parse_args()
    seeds = range(args.first, args.first + args.programs)
    if args.python is None and args.judge is None:
        parser.error('--python or --judge is needed')
    with tempfile.TemporaryDirectory(prefix='ros2cc-record-') as folder:
        record = args.judge or args.record or Path(folder) / 'record.jsonl'
        if args.judge is None:
            run(record, args.python, seeds)
        if args.record is None or args.judge is not None:
            judge_all(record, seeds, args.jobs, args.known)
        if args.python is not None:
            disturb(record, args.python, seeds)
        tally = Tally()
        for ran in load(record).values():
            if ran.seed in seeds and ran.judged is not None:
                tally.add(ran)
    print(tally)
    return 1 if tally.missed else 0


if __name__ == '__main__':
    sys.exit(main())
