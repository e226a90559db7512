"""
Decides the queries of a large unit with few states: by slices, and each shape of slice once.

What slices cannot decide is asked of the whole unit, as far as the limits go.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.known_answers import Shelf
from ros2cc_extract.verify.search.search_results import (
    Found,
    Search,
    key_of,
    total,
    unasked,
    weighs_more,
)
from ros2cc_extract.verify.slices.guided_runs import refute_by_hunts
from ros2cc_extract.verify.slices.pool_exhaustion import Refute, refute_by_crowds
from ros2cc_extract.verify.slices.relaxed_units import Loosened, is_loose, loosened
from ros2cc_extract.verify.slices.separate_waits import prove_apart
from ros2cc_extract.verify.slices.slice_queries import Slicing
from ros2cc_extract.verify.slices.slicer import Slicer
from ros2cc_extract.verify.slices.wait_relations import Names


@dataclass(frozen=True)
class Refuters:
    """
    Searches that refute and prove nothing.

    :param over_waypoints: asks parts, where no slice shows that a free thread comes.
    :param by_chance: asks the whole unit, whose runs may end too far from the start for others.
    """

    over_waypoints: Refute
    by_chance: Search


#: What a run refutes by its end.
SHOWN_BY_ENDS = (Family.DEADLOCK, Family.PROGRESS, Family.POOL_EXHAUSTION, Family.STARVATION)
#: A unit of up to so many callbacks is explored as a whole if it has no more states than that.
SMALL = 8
FIRST_LOOK_STATES = 20_000
#: Most states of the whole unit, where no limit of the user's says less; ``None`` for all.
WHOLE_STATES: int | None = None


def narrow(
    closed: ClosedSpec,
    queries: Sequence[Query],
    max_cycle: int,
    search: Search,
    limits: Limits,
    shelf: Shelf | None = None,
    refuters: Refuters | None = None,
) -> Found:
    """
    Decide ``queries`` of the unit, whose callbacks get at most ``max_cycle`` arrivals each.

    :param shelf: answers that hold for slices of other units too.
    :param refuters: look for runs that slices do not show.
    """
    limits = limits.begun()
    found: Found | None = None
    if len(closed.spec.callbacks) <= SMALL:
        first = replace(limits, states=FIRST_LOOK_STATES)
        found = search(closed, [key_of(query) for query in queries], first)
        if found.check.complete:
            return found
    slicer = Slicer(closed, max_cycle)
    found = found and _derive(found, queries, slicer)
    ways = _Ways(slicer, search, refuters, limits, Shelf() if shelf is None else shelf)
    for way in ways.in_order():
        if limits.is_over:
            break
        left = _left(queries, found)
        part = way(left) if left else None
        if part is not None:
            found = _derive(part if found is None else joined(found, part), queries, slicer)
    rest = [key_of(query) for query in _left(queries, found)]
    if rest or found is None:
        most = replace(limits, states=limits.states or WHOLE_STATES)
        whole = unasked(queries, rest, limits) if limits.is_over else search(closed, rest, most)
        found = whole if found is None else joined(found, whole)
    complete = not any(map(_is_open, found.results.values()))
    return replace(found, check=replace(found.check, complete=complete))


def _left(queries: Iterable[Query], found: Found | None) -> list[Query]:
    """What asking more may decide."""
    results = {} if found is None else found.results
    return [query for query in queries if _is_undecided(results.get(key_of(query)))]


_Way = Callable[[Sequence[Query]], Found | None]
_Refuting = Callable[[Slicer, Sequence[Query], Refute, Limits], Found | None]


@dataclass(frozen=True)
class _Ways:
    """What may decide claims without the whole unit, each asked for what those before left."""

    slicer: Slicer
    search: Search
    refuters: Refuters | None
    limits: Limits
    shelf: Shelf

    def in_order(self) -> Iterator[_Way]:
        """Give them, those first that take least."""
        yield partial(self._by_slices, last=False)
        # What starves follows from what comes to no end, as a rule.
        yield partial(self._by_slices, last=True)
        if not self.slicer.spins:
            for loose in loosened(self.slicer.closed):
                yield partial(self._loosened, loose)
        if self.refuters is not None:
            over_waypoints = self.refuters.over_waypoints
            if not self.slicer.has_threads_to_spare:
                yield partial(self._refuted, over_waypoints, refute_by_crowds)
            yield partial(self._refuted, over_waypoints, refute_by_hunts)
        yield self._apart
        if self.refuters is not None:
            yield partial(self._by_chance, self.refuters.by_chance)

    def _by_slices(self, left: Sequence[Query], *, last: bool) -> Found | None:
        slicing = Slicing(self.slicer, self.search, self.limits, self.shelf)
        return slicing.decide(q for q in left if (q.family is Family.STARVATION) is last)

    def _loosened(self, loose: Loosened, left: Sequence[Query]) -> Found | None:
        slicer = Slicer(loose.closed, self.slicer.max_cycle)
        slicing = Slicing(slicer, self.search, self.limits, self.shelf)
        part = slicing.decide(
            query for query in left if is_loose(query, self.slicer.closed, slicer.max_cycle)
        )
        if part is None:
            return None
        results = loose.decided(part.results)
        return replace(part, results=results, by_slices=len(results))

    def _refuted(self, refute: Refute, way: _Refuting, left: Sequence[Query]) -> Found | None:
        return way(self.slicer, left, refute, self.limits)

    def _by_chance(self, dive: Search, left: Sequence[Query]) -> Found | None:
        keys = [key_of(query) for query in left if query.family in SHOWN_BY_ENDS]
        return dive(self.slicer.closed, keys, self.limits) if keys else None

    def _apart(self, left: Sequence[Query]) -> Found | None:
        return prove_apart(self.slicer, left, self.search, self.limits)


def _is_undecided(result: QueryResult | None) -> bool:
    return result is None or _is_open(result)


def _is_open(result: QueryResult) -> bool:
    """True where asking more may decide it; what is not known stays so."""
    return result.verdict is Verdict.UNDECIDED and not result.in_doubt


def joined(found: Found, part: Found) -> Found:
    """Add what a slice, or the whole unit, has decided."""
    results = dict(found.results)
    for key, result in part.results.items():
        if key not in results or _is_open(results[key]) or weighs_more(result, results[key]):
            results[key] = result
    return Found(results, total((found.check, part.check)), found.by_slices + part.by_slices)


def _derive(found: Found, queries: Iterable[Query], slicer: Slicer) -> Found:
    """Decide what follows from verdicts on slices; see docs/profile-rclpy.md, *Slices*."""
    results = dict(found.results)
    for query in queries:
        result = results.get(key_of(query))
        if result is None or _is_open(result):
            derived = _derived(query, found, slicer)
            if derived is not None:
                results[key_of(query)] = replace(derived, family=query.family.value)
    return replace(found, results=results)


def _derived(query: Query, found: Found, slicer: Slicer) -> QueryResult | None:
    if query.family is Family.SERIAL:
        return _never_together(found, slicer.closed.spec)
    if not slicer.has_threads_to_spare:
        return None
    if query.family is Family.DEADLOCK:
        return _all_end(found, slicer.asked)
    if query.family is Family.STARVATION:
        holders = slicer.holders_from(query.callbacks[0])
        ends = _all_end(found, holders) if slicer.only_asks(holders) else None
        return ends if ends is not None and ends.verdict is Verdict.SATISFIED else None
    if query.family is Family.POOL_EXHAUSTION:
        return _satisfied(found)
    return None


def _all_end(found: Found, names: Names) -> QueryResult | None:
    """Whether all of ``names`` come to an end, or one that does not; ``None`` if that is open."""
    ends = [found.results.get((Family.PROGRESS, (name,), ())) for name in sorted(names)]
    for result in ends:
        if result is not None and result.verdict is Verdict.NOT_SATISFIED:
            return result
    if any(result is None or _is_open(result) for result in ends):
        return None
    doubted = next((result for result in ends if result is not None and result.in_doubt), None)
    return doubted or _satisfied(found)


def _satisfied(found: Found) -> QueryResult | None:
    """Give what follows from verdicts, with the words of any; ``None`` if there is none yet."""
    some = next(iter(found.results.values()), None)
    if some is None:
        return None
    return replace(some, verdict=Verdict.SATISFIED, reason=None, run=None, in_doubt=False)


def _never_together(found: Found, spec: Spec) -> QueryResult | None:
    """No two threads run at once if no two callbacks do, and none overlaps itself."""
    apart = [r for (family, *_), r in found.results.items() if family in _OF_ONE_THREAD]
    refuted = next((r for r in apart if r.verdict is Verdict.NOT_SATISFIED), None)
    size = len(spec.callbacks)
    all_hold = all(r.verdict is Verdict.SATISFIED for r in apart)
    if refuted is None and all_hold and len(apart) == size * (size + 1) // 2:
        return apart[0]
    return refuted


_OF_ONE_THREAD = (Family.NEVER_TOGETHER, Family.SELF_OVERLAP)
