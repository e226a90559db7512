"""
Random systems: one that hung on real rclpy must not be *satisfied*.

``python -m tests.random_systems.suite --python PYTHON --record FILE`` draws systems and runs them,
several side by side, judges what the record has, and puts each system into one big network too,
where that shows it as it is, to compare. With ``--unrun`` it runs none, and judges in both ways
those that one network shows. All go on where they were cut.
"""

from __future__ import annotations

import argparse
import io
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.findings.promises import Mark, Promise
from ros2cc_extract.generator.build import Family, Profile
from ros2cc_extract.jobs.pools import Processes
from ros2cc_extract.pipeline.check import Job, Outcome, check_paths
from ros2cc_extract.pipeline.config import Config
from ros2cc_extract.pipeline.system_sources import scan_launch_files
from ros2cc_extract.pipeline.unit_task import of_joined
from ros2cc_extract.spec.assumptions import Assumptions
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.joined_executors import has_threads_enough, put_together
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.circles.joined_processes import circles_of, whole_of
from ros2cc_extract.spec.system.circles.part_names import renamed_parts
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit
from tests.random_systems.programs import write

SATISFIED, UNDECIDED, NOT_SATISFIED = 'satisfied', 'undecided', 'not satisfied'
NOT_EXACT, TOO_LARGE = 'no one network shows it', 'too large'
_FAMILIES = frozenset({Family.DEADLOCK, Family.PROGRESS})
_OF_WAITS = _FAMILIES | {Family.POOL_EXHAUSTION, Family.ANSWERED_SPIN}
OPTIONS = Options(
    profile=Profile.RCLPY, structural=False, limits=Limits(seconds=30.0), families=_OF_WAITS
)
RELEASE = '7.1.6'
_MOST_STATES = 300_000
_WHOLE_S = 20.0
_PROMISES = (Promise.DEADLOCK, Promise.WAITS)
CHUNK = 56


def judged(folder: Path, seed: int, release: str = RELEASE) -> dict[str, Any]:
    """What is said of a system by its parts, and by one network of all."""
    path = write(seed, folder)
    os.chdir(folder)
    found = _by_parts_and_said(path.relative_to(folder), folder, release)
    return {'seed': seed, **found, 'whole': by_one_network(_system(path.relative_to(folder)))}


def compared(folder: Path, seed: int) -> dict[str, Any]:
    """The same, without its parts where one network does not show it."""
    path = write(seed, folder)
    os.chdir(folder)
    whole = by_one_network(_system(path.relative_to(folder)))
    is_shown = whole not in (NOT_EXACT, TOO_LARGE)
    found = _by_parts_and_said(path.relative_to(folder), folder) if is_shown else {}
    return {'seed': seed, **found, 'whole': whole}


def _by_parts_and_said(path: Path, folder: Path, release: str = RELEASE) -> dict[str, Any]:
    outcome = check_paths(_job(path, folder, release), io.StringIO())
    return {'said': said_of(outcome), 'parts': by_parts(outcome)}


def _system(path: Path) -> System:
    return scan_launch_files([path], {}, io.StringIO(), cached=False).system


def _job(path: Path, folder: Path, release: str) -> Job:
    return Job(
        paths=[path],
        config=Config(root=folder),
        policy=Policy(),
        options=OPTIONS,
        assumptions=Assumptions(rclpy=release),
        root=folder,
        cached=False,
        pool=Processes(1),
    )


def said_of(outcome: Outcome) -> str:
    """The two promises on waits, of all units together."""
    errors = [f for f in outcome.findings if f.code[:3] == 'CC1' and f.severity is Severity.ERROR]
    judgements = (each for of_unit in outcome.promises for each in of_unit)
    marks = {each.mark for each in judgements if each.promise in _PROMISES}
    if errors or Mark.BROKEN in marks:
        return NOT_SATISFIED
    return UNDECIDED if Mark.OPEN in marks else SATISFIED


def by_parts(outcome: Outcome) -> str:
    """The verdicts of all units, and of the circles of processes, one by one."""
    assert outcome.system is not None
    circles = circles_of(outcome.system)
    verdicts = [
        result.verdict
        for verification in outcome.judged
        for result in verification.results
        if result.family in {each.value for each in _FAMILIES}
    ]
    for circle in circles.joined:
        verdicts += _verdicts(circle.spec, of_joined(OPTIONS))
    return _worst([*verdicts, *(Verdict.UNDECIDED for _ in circles.open)])


def by_one_network(system: System) -> str:
    """One network of all processes, explored without slices."""
    parts = renamed_parts(system.processes)
    if not all(len(each.executor.threads) == 1 or has_threads_enough(each) for each in parts):
        return NOT_EXACT
    one = put_together(whole_of(parts), parts)
    if one is None:
        return NOT_EXACT
    if not one.callbacks:  # nobody waits for anybody
        return SATISFIED
    limits = Limits(seconds=_WHOLE_S, states=_MOST_STATES)
    found = _worst(_verdicts(one, replace(OPTIONS, limits=limits)))
    return TOO_LARGE if found == UNDECIDED else found


def _verdicts(unit: Spec, options: Options) -> list[Verdict]:
    asked = replace(options, families=_FAMILIES)
    return [result.verdict for result in verify_unit(close(unit, Policy()), asked).results]


def _worst(verdicts: Iterable[Verdict]) -> str:
    known = set(verdicts)
    if Verdict.NOT_SATISFIED in known:
        return NOT_SATISFIED
    return UNDECIDED if Verdict.UNDECIDED in known else SATISFIED


def run(record: Path, python: str, seeds: Sequence[int], first_domain: int) -> None:
    """Run what was not run yet, and write down who stood still."""
    known = {row['seed'] for row in load(record)}
    left = [seed for seed in seeds if seed not in known]
    env = {**os.environ, 'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST'}
    for start in range(0, len(left), CHUNK):
        with tempfile.TemporaryDirectory(prefix='ros2cc-systems-') as folder:
            drawn = {str(Path(folder) / str(s) / 'programs'): s for s in left[start:][:CHUNK]}
            for seed in drawn.values():
                write(seed, Path(folder) / str(seed))
            out = Path(folder) / 'out.jsonl'
            words = ['-m', 'tests.random_systems.watch', str(out), str(first_domain), *drawn]
            subprocess.run([python, *words], env=env, check=True)
            add(
                record,
                ({'seed': drawn[row['folder']], 'stuck': row['stuck']} for row in load(out)),
            )
        print(f'{min(start + CHUNK, len(left))} of {len(left)} run', flush=True)


def judge_all(record: Path, seeds: Sequence[int], jobs: int, release: str = RELEASE) -> None:
    """Judge what a record has, and write it beside."""
    run_ones = [row['seed'] for row in load(record) if row['seed'] in seeds]
    _judge_left(partial(_judge, release=release), run_ones, _judgements(record), jobs)


def compare_all(record: Path, seeds: Sequence[int], jobs: int) -> None:
    """Judge systems in both ways, whether they were run or not."""
    _judge_left(_compare, seeds, record, jobs)


def _judge_left(
    judge: Callable[[int], dict[str, Any]], seeds: Iterable[int], record: Path, jobs: int
) -> None:
    known = {row['seed'] for row in load(record)}
    left = [seed for seed in seeds if seed not in known]
    with multiprocessing.Pool(jobs, maxtasksperchild=20) as pool:
        for row in pool.imap_unordered(judge, left):
            add(record, [row])


def _judge(seed: int, release: str) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix='ros2cc-judged-') as folder:
        return judged(Path(folder), seed, release)


def _compare(seed: int) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix='ros2cc-judged-') as folder:
        return compared(Path(folder), seed)


def _judgements(record: Path) -> Path:
    return record.with_suffix('.judged.jsonl')


def load(path: Path) -> list[dict[str, Any]]:
    text = path.read_text(encoding='utf-8') if path.exists() else ''
    return [json.loads(line) for line in text.splitlines()]


def add(path: Path, rows: Iterable[dict[str, Any]]) -> None:
    with path.open('a', encoding='utf-8') as stream:
        stream.writelines(f'{json.dumps(row)}\n' for row in rows)


def told(record: Path, seeds: Sequence[int]) -> Iterator[str]:
    """The table, and every system that contradicts it."""
    stuck = {row['seed']: row['stuck'] for row in load(record) if row['seed'] in seeds}
    rows = [row for row in load(_judgements(record)) if row['seed'] in stuck]
    table = Counter((bool(stuck[row['seed']]), row['said']) for row in rows)
    yield f'{len(stuck)} run, {sum(map(bool, stuck.values()))} hung, {len(rows)} judged'
    for hung in (True, False):
        counts = ', '.join(f'{table[hung, s]} {s}' for s in (NOT_SATISFIED, UNDECIDED, SATISFIED))
        yield f'{"hung" if hung else "went on"}: {counts}'
    yield from told_of_both(rows)
    yield from (f'{row["seed"]}: hung {stuck[row["seed"]]}, {row}' for row in wrong(rows, stuck))


def told_of_both(rows: Sequence[dict[str, Any]]) -> Iterator[str]:
    """How many systems one network shows, and of how many the parts say the same."""
    shown = [row for row in rows if row['whole'] in (SATISFIED, NOT_SATISFIED)]
    equal = sum(row['parts'] == row['whole'] for row in shown)
    undecided = sum(row['parts'] == UNDECIDED for row in shown)
    yield f'in one network too: {len(shown)}, equal {equal}, undecided by parts {undecided}'


def wrong(rows: Iterable[dict[str, Any]], stuck: Mapping[int, list[str]]) -> list[dict[str, Any]]:
    """Systems that hung and are satisfied, and those of which parts and whole say opposites."""
    return [
        row
        for row in rows
        if (stuck.get(row['seed']) and row['said'] == SATISFIED) or _are_opposites(row)
    ]


def _are_opposites(row: Mapping[str, Any]) -> bool:
    return {row.get('parts'), row['whole']} == {SATISFIED, NOT_SATISFIED} or (
        row.get('said'),
        row['whole'],
    ) == (SATISFIED, NOT_SATISFIED)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--python', help='an interpreter with rclpy')
    parser.add_argument('--first', type=int, default=0, help='first seed')
    parser.add_argument('--systems', type=int, default=1000)
    parser.add_argument('--record', type=Path, required=True, help='what was run')
    parser.add_argument('--domain', type=int, default=1, help='the first ROS domain of these')
    parser.add_argument('--jobs', type=int, default=os.cpu_count() or 1, help='who judge at once')
    parser.add_argument('--release', default=RELEASE, help='the rclpy of that interpreter')
    parser.add_argument('--unrun', action='store_true', help='compare only, without running any')
    args = parser.parse_args()
    seeds = range(args.first, args.first + args.systems)
    record = args.record.absolute()
    if args.unrun:
        compare_all(record, seeds, args.jobs)
        rows = [row for row in load(record) if row['seed'] in seeds]
        print('\n'.join([*told_of_both(rows), *map(str, wrong(rows, {}))]))
        return 1 if wrong(rows, {}) else 0
    if args.python is not None:
        run(record, str(Path(args.python).absolute()), seeds, args.domain)
    judge_all(record, seeds, args.jobs, args.release)
    print('\n'.join(told(record, seeds)))
    stuck = {row['seed']: row['stuck'] for row in load(record) if row['seed'] in seeds}
    rows = [row for row in load(_judgements(record)) if row['seed'] in stuck]
    return 1 if wrong(rows, stuck) else 0


if __name__ == '__main__':
    sys.exit(main())
