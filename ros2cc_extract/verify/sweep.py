"""
Verifies one unit for a range of thread counts and arrival bounds.

A sweep answers what one verification cannot: from how many threads on a verdict is another one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Family
from ros2cc_extract.jobs.pools import Pool, in_order
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

PROGRESS = Family.PROGRESS.value
OF_DEADLOCK = (Family.DEADLOCK.value, PROGRESS, Family.POOL_EXHAUSTION.value)


@dataclass(frozen=True)
class Point:
    """One setting of a sweep; ``max_cycle`` bounds how often a callback becomes ready."""

    threads: int
    max_cycle: int | None


@dataclass(frozen=True)
class Turn:
    """
    A query whose verdict changes along the thread counts of a sweep.

    :param threads: smallest thread count with the new verdict.
    """

    query: int
    max_cycle: int | None
    threads: int
    before: Verdict
    after: Verdict


@dataclass(frozen=True)
class Sweep:
    """All verifications of a unit, in the order of the points."""

    unit: str
    points: tuple[Point, ...]
    verifications: tuple[Verification, ...]

    @property
    def asks_for_progress(self) -> bool:
        """Whether any callback waits, and the profile asks whether it may wait forever."""
        return any(r.family == PROGRESS for v in self.verifications for r in v.results)

    def least_threads(self) -> int | None:
        """
        Give the smallest thread count from which on nothing waits forever.

        Of the counts that were asked, with every arrival bound; ``None`` if none of them will
        do, or if the profile does not ask.
        """
        stuck = [
            p.threads for p, v in zip(self.points, self.verifications, strict=True) if _hangs(v)
        ]
        enough = [p.threads for p in self.points if p.threads > max(stuck, default=0)]
        return min(enough) if self.asks_for_progress and enough else None

    def turns(self) -> tuple[Turn, ...]:
        """List where a verdict changes from one thread count to the next."""
        found: list[Turn] = []
        pairs = list(zip(self.points, self.verifications, strict=True))
        for (last, before), (point, after) in pairwise(pairs):
            if last.max_cycle == point.max_cycle:
                found.extend(_turns(point, before, after))
        return tuple(found)


def points(threads: Iterable[int], max_cycles: Iterable[int | None]) -> tuple[Point, ...]:
    """All settings, thread counts ascending within each arrival bound, as these are given."""
    counts = sorted(set(threads))
    return tuple(Point(t, cycle) for cycle in dict.fromkeys(max_cycles) for t in counts)


def run_sweep(
    unit: Spec,
    policy: Policy,
    options: Options,
    settings: Sequence[Point],
    pool: Pool,
    on_done: Callable[[int], None] = lambda _done: None,
) -> Sweep:
    """
    Verify ``unit`` at every point.

    :param pool: what runs the points.
    :param on_done: called with the number of points done.
    """
    tasks = [(unit, replace(policy, threads=p.threads), _at(options, p)) for p in settings]
    verifications = in_order(pool, _verify, tasks, on_done)
    return Sweep(unit.name, tuple(settings), tuple(verifications))


def _hangs(verification: Verification) -> bool:
    """What is undecided may hang too."""
    return any(
        result.verdict is not Verdict.SATISFIED
        for result in verification.results
        if result.family in OF_DEADLOCK
    )


def _at(options: Options, point: Point) -> Options:
    return replace(options, max_cycle=point.max_cycle)


def _verify(task: tuple[Spec, Policy, Options]) -> Verification:
    unit, policy, options = task
    verification = verify_unit(close(unit, policy), options)
    # Runs are found out in this process, for the sake of those that another one waits for.
    with_runs = tuple(replace(result, run=result.evidence) for result in verification.results)
    return replace(verification, results=with_runs)


def _turns(point: Point, before: Verification, after: Verification) -> Iterable[Turn]:
    for number, (old, new) in enumerate(zip(before.results, after.results, strict=True), start=1):
        if old.verdict is not new.verdict:
            yield Turn(number, point.max_cycle, point.threads, old.verdict, new.verdict)
