"""
Refutes claims of a unit whose callbacks may take all threads while they wait.

Then nothing shows that a free thread comes, so no claim about ends is proven by slices. But a run
in which some of them take all threads forever is a run of the unit. It is looked for over
waypoints: one after the other gets data, runs and waits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Family, Profile, Query, queries_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.results.evidence import Evidence
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import SLICE_STATES, Found, Key, key_of
from ros2cc_extract.verify.slices.slicer import Slicer
from ros2cc_extract.verify.slices.wait_relations import Names

Refute = Callable[[ClosedSpec, Sequence[Key], Sequence[str], Limits], Found]
"""Asks a part over waypoints; gives what is refuted."""

MOST_CROWDS = 8
MOST_CALLBACKS = 40
"""A larger part takes longer to read than it may be worth."""
_ABOUT = (Family.DEADLOCK, Family.POOL_EXHAUSTION, Family.PROGRESS, Family.STARVATION)


@dataclass(frozen=True)
class Crowd:
    """
    Callbacks that may take all threads while they wait.

    :param names: theirs, in the order in which they begin.
    :param part: they, and the callbacks that may end their waits, as a unit.
    """

    names: tuple[str, ...]
    part: ClosedSpec

    @property
    def members(self) -> Names:
        """All callbacks of the part."""
        return frozenset(callback.name for callback in self.part.spec.callbacks)

    def waypoints(self, more: Sequence[str] = ()) -> tuple[str, ...]:
        """
        Say how they take the threads; then data arrives for the others.

        :param more: those for which data has to arrive as well.
        """
        spec = self.part.spec
        places = {callback.name: place for place, callback in enumerate(spec.callbacks)}
        threads = [f'{thread}.blocked' for thread in spec.executor.threads]
        ways = []
        for number, name in enumerate(self.names):
            before = ''.join(f' and {thread}' for thread in threads[:number])
            ways.append(f'E<> cb_waiting[{places[name]}] > 0{before}')
            ways.append(f'E<> cb_running({places[name]}) and {threads[number]}{before}')
        others = [name for name in places if name not in self.names and name not in more]
        full = ' and '.join(threads)
        ways += [f'E<> cb_waiting[{places[name]}] > 0 and {full}' for name in (*more, *others)]
        return tuple(ways)


def refute_by_crowds(
    slicer: Slicer, queries: Sequence[Query], refute: Refute, limits: Limits
) -> Found | None:
    """Refute what crowds refute of ``queries``; ``None`` if there are no crowds, or none does."""
    left = {key_of(query): query for query in queries if query.family in _ABOUT}
    found: Found | None = None
    limits = replace(limits, states=SLICE_STATES)
    tried: set[tuple[str, ...]] = set()
    while len(tried) < MOST_CROWDS and left and not limits.is_over:
        crowd = next((c for c in _crowds(slicer, left.values()) if c.names not in tried), None)
        if crowd is None:
            break
        tried.add(crowd.names)
        part = refute(crowd.part, _asked(crowd, left, slicer.max_cycle), crowd.waypoints(), limits)
        results = {**part.results, **_starving(part, crowd, slicer, left, refute)}
        part = replace(part, results=results, by_slices=len(results))
        left = {key: query for key, query in left.items() if key not in results}
        if results:
            found = part if found is None else added(found, part)
    return found


def added(found: Found, part: Found) -> Found:
    """Add what a part has refuted."""
    check = replace(
        found.check,
        states=found.check.states + part.check.states,
        transitions=found.check.transitions + part.check.transitions,
    )
    return Found({**part.results, **found.results}, check, found.by_slices + part.by_slices)


def _crowds(slicer: Slicer, left: Iterable[Query]) -> Iterator[Crowd]:
    """Crowds that may refute what is left: they hold what should end, and not what starves."""
    queries = list(left)
    starving = _about(Family.STARVATION, queries)
    unfinished = _about(Family.PROGRESS, queries)
    for query in queries:
        own = frozenset(query.callbacks)
        if query.family is Family.STARVATION:
            others = frozenset(slicer.waiting - starving)
            names = slicer.crowd(first=(), rather=others, without=own)
        else:
            first = query.callbacks if query.family is Family.PROGRESS else ()
            names = slicer.crowd(first=first, rather=unfinished, without=frozenset())
        crowd = None if names is None else _crowd(slicer, names)
        if crowd is not None:
            yield crowd


def _about(family: Family, queries: Iterable[Query]) -> Names:
    return frozenset(name for q in queries if q.family is family for name in q.callbacks)


def _crowd(slicer: Slicer, names: tuple[str, ...]) -> Crowd | None:
    part = slicer.part_of_crowd(names)
    if part is None or len(part.spec.callbacks) > MOST_CALLBACKS:
        return None
    return Crowd(names, part)


def _asked(crowd: Crowd, left: Mapping[Key, Query], max_cycle: int) -> list[Key]:
    """What the part is asked: of its pool always, as all else rests on that."""
    every = queries_of(crowd.part, profile=Profile.RCLPY, max_cycle=max_cycle)
    return [key_of(query) for query in every if query.family is _POOL or key_of(query) in left]


def _starving(
    part: Found,
    crowd: Crowd,
    slicer: Slicer,
    left: Mapping[Key, Query],
    refute: Refute,
) -> dict[Key, QueryResult]:
    """
    What the run of a crowd means for the unit.

    All threads are taken forever: all that arrives afterwards for others starves.
    """
    taken = next((r for (family, *_), r in part.results.items() if family is _POOL), None)
    if taken is None or taken.verdict is not Verdict.NOT_SATISFIED:
        return {}
    found: dict[Key, QueryResult] = {}
    for key, query in left.items():
        if query.family is _POOL:
            found[key] = _as_of(query, taken)
        elif query.family is Family.STARVATION:
            (name,) = query.callbacks
            if name not in crowd.members and slicer.gets_data(name):
                run = partial(_run_of_starving, name, crowd, slicer, refute)
                found[key] = replace(_as_of(query, taken), run=run)
    return found


_POOL = Family.POOL_EXHAUSTION


def _as_of(query: Query, result: QueryResult) -> QueryResult:
    return replace(
        result,
        family=query.family.value,
        formula=query.formula,
        words=query.words,
        callbacks=query.callbacks,
    )


def _run_of_starving(name: str, crowd: Crowd, slicer: Slicer, refute: Refute) -> Evidence:
    """Find the run of a crowd after which data arrives for ``name``."""
    part = slicer.cut(crowd.members | {name})
    key = (Family.STARVATION, (name,), ())
    waypoints = Crowd(crowd.names, part).waypoints((name,))
    found = refute(part, [key], waypoints, Limits(states=SLICE_STATES))
    evidence = found.results[key].evidence
    assert evidence is not None, 'only asked of claims that were refuted'
    return evidence
