"""
Compares the verdicts of the plain and the compact text of a profile, on units drawn by number.

``python tests/property/compared_texts.py rclpy --units 2000 --record FILE`` compares and says
how many units agree. What FILE already holds of the same texts is not done again, so that a long
series may be cut at any time.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from random import Random

from closed_specs import random_rclpy_unit, random_unit

from ros2cc_extract.checker.api import Fairness, Limits, Query, Verdict, check, read_model
from ros2cc_extract.generator.build import Profile, Text, render
from ros2cc_extract.jobs.process_pool import ProcessPool, usable_cores
from ros2cc_extract.spec.close import ClosedSpec

Verdicts = dict[str, Verdict]
#: Units between two looks at the clock, and two writings of the record.
BATCH = 20
#: First unit of the numbers of record; continuous integration counts from 0.
FIRST = 1_000


@dataclass(frozen=True)
class Case:
    """A drawn unit; without a bound on arrivals only fair runs count."""

    unit: ClosedSpec
    profile: Profile
    max_cycle: int | None

    def text(self, text: Text) -> str:
        """Write the model, queries included."""
        return render(self.unit, profile=self.profile, text=text, max_cycle=self.max_cycle).xml


def paper_case(number: int) -> Case:
    random = Random(number)
    max_cycle = random.choice((1, 2, 3, None))
    unit = random_unit(random, callbacks=4, groups=3, threads=3)
    return Case(unit, Profile.PAPER, max_cycle)


def rclpy_case(number: int) -> Case:
    random = Random(number)
    max_cycle = random.choice((1, 1, 2, 3, None))
    unit = random_rclpy_unit(random, callbacks=4, groups=3, threads=3)
    return Case(unit, Profile.RCLPY, max_cycle)


DRAWS: dict[str, Callable[[int], Case]] = {'paper': paper_case, 'rclpy': rclpy_case}


@dataclass(frozen=True)
class Effort:
    """
    How far texts are explored.

    :param states: of a search without reductions.
    :param reduced_states: of a search with reductions for what that left open; 0 for none.
    """

    states: int
    reduced_states: int = 0
    memory_mb: int = 3_000

    @property
    def most(self) -> int:
        """States of the largest search."""
        return max(self.states, self.reduced_states)


@dataclass(frozen=True)
class Comparison:
    """
    Both texts of a unit.

    :param texts: digest of both texts: what the rest holds for.
    :param states: how many a search might look at at most; what it decided holds for more too.
    :param queries: how many were asked.
    :param is_reduced: not all were decided without reductions.
    :param open: formulas that the effort did not decide in both texts.
    :param differing: formula to plain and compact verdict.
    """

    number: int
    texts: str
    states: int
    queries: int
    is_reduced: bool = False
    open: Sequence[str] = ()
    differing: dict[str, Sequence[str]] = field(default_factory=dict)


def compare(number: int, case: Case, effort: Effort) -> Comparison:
    """Explore both texts, and compare all that both decide."""
    plain = _verdicts(case, Text.PLAIN, effort)
    compact = _verdicts(case, Text.COMPACT, effort)
    pairs = {formula: (verdict, compact.of[formula]) for formula, verdict in plain.of.items()}
    undecided = [formula for formula, pair in pairs.items() if Verdict.UNDECIDED in pair]
    return Comparison(
        number=number,
        texts=digest(case),
        states=effort.most,
        queries=len(pairs),
        is_reduced=plain.is_reduced or compact.is_reduced,
        open=undecided,
        differing={
            formula: (one.value, other.value)
            for formula, (one, other) in pairs.items()
            if one is not other and formula not in undecided
        },
    )


def digest(case: Case) -> str:
    told = (*(case.text(text) for text in Text), case.max_cycle)
    return hashlib.sha256(repr(told).encode()).hexdigest()[:16]


@dataclass(frozen=True)
class _Explored:
    of: Verdicts
    is_reduced: bool


def _verdicts(case: Case, text: Text, effort: Effort) -> _Explored:
    model = read_model(case.text(text), f'{text.value}.xml')
    fairness = Fairness.WEAK if case.max_cycle is None else Fairness.NONE

    def decide(queries: Sequence[Query], states: int, *, reduction: bool) -> Verdicts:
        limits = Limits(states=states, memory_mb=effort.memory_mb)
        result = check(model, queries, limits=limits, fairness=fairness, reduction=reduction)
        return {answer.query.formula: answer.verdict for answer in result.answers}

    found = decide(model.queries, effort.states, reduction=False)
    left = [query for query in model.queries if found[query.formula] is Verdict.UNDECIDED]
    if left and effort.reduced_states:
        return _Explored(
            {**found, **decide(left, effort.reduced_states, reduction=True)}, is_reduced=True
        )
    return _Explored(found, is_reduced=False)


def read_record(path: Path) -> dict[int, Comparison]:
    """Read what was compared before; a line may have been cut."""
    found = {}
    for line in path.read_text().splitlines() if path.exists() else ():
        try:
            comparison = Comparison(**json.loads(line))
        except ValueError:
            continue
        found[comparison.number] = comparison
    return found


def compare_series(
    profile: str,
    numbers: Sequence[int],
    effort: Effort,
    record: Path | None,
    seconds: float,
    jobs: int | None = None,
) -> list[Comparison]:
    """Compare the units of ``numbers`` in ``jobs`` processes, as far as ``seconds`` go."""
    draw = DRAWS[profile]
    known = read_record(record) if record else {}
    kept = {
        n: known[n]
        for n in numbers
        if n in known
        and known[n].texts == digest(draw(n))
        and (not known[n].open or known[n].states >= effort.most)
    }
    found = list(kept.values())
    left = [number for number in numbers if number not in kept]
    started = time.monotonic()
    size = usable_cores(jobs)
    with ProcessPool(lambda number: compare(number, draw(number), effort), size) as pool:
        for batch in _batches(left):
            if time.monotonic() - started > seconds:
                break
            new = [comparison for comparison, _ in pool.ask(batch)]
            found += new
            if record:
                with record.open('a') as stream:
                    stream.writelines('\n' + json.dumps(asdict(each)) for each in new)
    return found


def _batches(numbers: Sequence[int]) -> Iterator[Sequence[int]]:
    for start in range(0, len(numbers), BATCH):
        yield numbers[start : start + BATCH]


def sum_up(profile: str, found: Sequence[Comparison]) -> str:
    """Say what came of a series."""
    reduced = sum(each.is_reduced for each in found if not each.open)
    undecided = sorted(each.number for each in found if each.open)
    questions = sum(each.queries for each in found)
    unanswered = sum(len(each.open) for each in found)
    differing = {each.number: each.differing for each in found if each.differing}
    numbers = f' {undecided}' if undecided else ''
    return (
        f'profile {profile}, plain and compact text of {len(found)} units: '
        f'{len(found) - len(undecided)} decided in full ({reduced} with reductions), '
        f'{len(undecided)} not{numbers}; {questions - unanswered} of {questions} verdicts '
        f'compared, units that differ: {differing or "none"}'
    )


def main() -> int:
    parser = argparse.ArgumentParser(description='Compare plain and compact texts of units.')
    parser.add_argument('profile', choices=DRAWS)
    parser.add_argument('--first', type=int, default=FIRST, help='number of the first unit')
    parser.add_argument('--units', type=int, default=2_000)
    parser.add_argument('--record', type=Path, help='file to go on from, and to add to')
    parser.add_argument('--seconds', type=float, default=float('inf'), help='then stop')
    parser.add_argument('--states', type=int, default=200_000, help='without reductions')
    parser.add_argument('--reduced-states', type=int, default=8_000_000)
    parser.add_argument('--memory-mb', type=int, default=Effort.memory_mb, help='of each search')
    parser.add_argument('--jobs', type=int, help='processes; default: one for each core')
    args = parser.parse_args()
    numbers = range(args.first, args.first + args.units)
    effort = Effort(args.states, args.reduced_states, args.memory_mb)
    found = compare_series(args.profile, numbers, effort, args.record, args.seconds, args.jobs)
    print(sum_up(args.profile, found))
    if len(found) < len(numbers):
        print(f'{len(numbers) - len(found)} units are left; call again with the same record')
    return 1 if any(each.differing for each in found) or len(found) < len(numbers) else 0


if __name__ == '__main__':
    sys.exit(main())
