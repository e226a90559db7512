"""
Explore against plain repetition, over the nodes here with a race or a rare hang: ``make explore``.

Plain repetition starts the same program beside the same stimulus again and again, and lets it run
for as long as it comes. Counted is how many runs it takes until the failure, as the median of
several tries; and how many replays of the failure show it again. Goes on where it was cut.
"""

from __future__ import annotations

import argparse
import functools
import json
import statistics
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ros2cc_extract.explore.exploring import Budget, Exploration, Strategy, explore
from ros2cc_extract.explore.failures import Failure
from ros2cc_extract.explore.first_look import first_look
from ros2cc_extract.explore.replaying import replay
from ros2cc_extract.explore.scenario import PLAIN, Found, Scenario
from ros2cc_extract.explore.watching import run_process

ROOT = Path(__file__).parents[2]
PLAIN_S = 3.0
BUGS = (
    'b12_pool_exhausted',
    'b13_services_call_each_other',
    'g1_none_between_test_and_use',
    'g1_state_across_groups',
    'g1_stop_written_over',
    'g2_lost_update',
    'g4_lock_order',
    'g4_lock_over_a_call',
)

# What fails in them needs a switch of threads that CPython with its global lock does not make.
WITHOUT_GIL = ('g1_none_between_test_and_use', 'g1_state_across_groups')


def nodes() -> list[Path]:
    own = sorted((ROOT / 'tests/explore/nodes').glob('*.py'))
    return [*own, *(ROOT / 'tests/bugs' / f'{name}.py' for name in BUGS)]


def scenario_of(path: Path, python: str, *, everywhere: bool) -> Scenario:
    return first_look((python, str(path)), python, Exploration(), everywhere=everywhere)[0]


def plain_runs(scenario: Scenario, python: str, most: int) -> tuple[int | None, float]:
    """How many runs it takes until something goes wrong, and how long."""
    begun = time.monotonic()
    for number in range(1, most + 1):
        rows = [{'number': 0, 'policy': PLAIN, 'seconds': PLAIN_S}]
        process = run_process(scenario, rows, python, until=lambda _: True)
        if any(seen.failures for seen in process.schedules):
            return number, time.monotonic() - begun
    return None, time.monotonic() - begun


def explored(
    scenario: Scenario, python: str, seed: int, most: int
) -> tuple[Found | None, int, float]:
    """The first failure, in which schedule it was, and how long it took."""
    begun, so_far = time.monotonic(), Exploration()
    run = functools.partial(run_process, scenario, python=python, until=lambda _: True)
    explore(run, Strategy.MIXED, seed, Budget(schedules=most, only_first=True), so_far)
    found = so_far.found[0] if so_far.found else None
    return found, so_far.done, time.monotonic() - begun


def replays(scenario: Scenario, found: Found, python: str, times: int) -> int:
    """How many of so many replays show the failure again."""

    def once(rows: Any, until: Any) -> Any:
        return run_process(scenario, rows, python, until=until)

    return sum(replay(found, once).failure is not None for _ in range(times))


def row_of(
    path: Path, python: str, args: argparse.Namespace, before: dict[str, Any] | None
) -> dict[str, Any]:
    """Measure a node; what is known of its plain runs from ``before`` stays."""
    everywhere = path.stem in args.without_gil
    scenario = scenario_of(path, python, everywhere=everywhere)
    plain = list(zip(before['plain'], before['plain_s'], strict=True)) if before else []
    while len(plain) < args.tries and all(count is not None for count, _ in plain):
        # Once in vain is enough: it would take that long each time.
        plain.append(plain_runs(scenario, python, args.runs))
    tries = [explored(scenario, python, seed, args.schedules) for seed in range(1, args.tries + 1)]
    found = next((each for each, _, _ in tries if each is not None), None)
    again = 0 if found is None else replays(scenario, found, python, args.replays)
    return {
        'node': str(path.relative_to(ROOT)),
        'failure': None if found is None else _shown(found.failure),
        'plain': [count for count, _ in plain],
        'plain_s': [round(seconds, 1) for _, seconds in plain],
        'explore': [count if each is not None else None for each, count, _ in tries],
        'explore_s': [round(seconds, 1) for _, _, seconds in tries],
        'replayed': again,
        'replays': args.replays if found is not None else 0,
    }


def twins(python: str, most: int) -> Iterator[str]:
    """Run schedules of each good twin, and say what was found in it: nothing should be."""
    for name in BUGS:
        path = ROOT / 'tests/bugs' / f'{name}_mended.py'
        so_far = Exploration()
        scenario = first_look((python, str(path)), python, so_far)[0]
        run = functools.partial(run_process, scenario, python=python)
        explore(run, Strategy.MIXED, 1, Budget(schedules=most), so_far)
        found = '; '.join(f'{_shown(each.failure)}: {each.failure.words}' for each in so_far.found)
        count = f'{so_far.done} schedules, {so_far.begins} callbacks'
        yield f'{path.name}: {count}: {found or "nothing"}'


def _shown(failure: Failure) -> str:
    return f'{failure.kind.value} at line {failure.line}'


def told(rows: list[dict[str, Any]], args: argparse.Namespace) -> Iterator[str]:
    yield '| node | failure | plain: runs | explore: schedules | seconds | replays |'
    yield '|---|---|---|---|---|---|'
    for row in rows:
        plain, own = _median(row['plain'], args.runs), _median(row['explore'], args.schedules)
        seconds = f'{statistics.median(row["plain_s"]):.0f} / '
        seconds += f'{statistics.median(row["explore_s"]):.0f}'
        again = f'{row["replayed"]} of {row["replays"]}'
        name = Path(row['node']).stem
        yield f'| {name} | {row["failure"] or "none"} | {plain} | {own} | {seconds} | {again} |'


def _median(counts: list[int | None], most: int) -> str:
    """Who did not get there in ``most`` runs counts as more than that."""
    found = statistics.median_high([most + 1 if each is None else each for each in counts])
    return f'> {most}' if found > most else f'{found}'


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument('--python', required=True)
    parser.add_argument('--record', type=Path, required=True)
    parser.add_argument('--tries', type=int, default=3)
    parser.add_argument('--runs', type=int, default=12)
    parser.add_argument('--schedules', type=int, default=100)
    parser.add_argument('--replays', type=int, default=5)
    parser.add_argument('--without-gil', nargs='*', default=list(WITHOUT_GIL))
    parser.add_argument('--again', action='store_true', help='keep what plain runs have shown')
    parser.add_argument('--twins', type=int, metavar='N', help='N schedules of each good twin')
    parser.add_argument('names', nargs='*')
    args = parser.parse_args()
    if args.twins:
        found = []
        for line in twins(args.python, args.twins):
            print(line, flush=True)
            found.append(line)
        return int(any(not line.endswith(': nothing') for line in found))
    kept = args.record.read_text().splitlines() if args.record.exists() else []
    rows = {row['node']: row for row in map(json.loads, kept)}
    with args.record.open('a', encoding='utf-8') as stream:
        for path in nodes():
            name = str(path.relative_to(ROOT))
            if (args.again or name not in rows) and (not args.names or path.stem in args.names):
                rows[name] = row_of(path, args.python, args, rows.get(name))
                stream.write(json.dumps(rows[name]) + '\n')
                stream.flush()
                print(json.dumps(rows[name]), flush=True)
    print('\n'.join(told(list(rows.values()), args)))
    return 0


if __name__ == '__main__':
    sys.exit(main())
