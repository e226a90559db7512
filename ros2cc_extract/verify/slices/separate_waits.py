"""
Proves that a callback ends by its waits, one at a time.

Each wait needs others, and with all of them at once a slice may have too many states. Where only
the callback itself waits, and it runs once, all others end, and hold nothing
forever. So a run in which it stays in one of its waits is, without the others, one of the callback
that has that wait alone: it may take as long before it as the others took. If it ends with each of
its waits alone, it ends. Not where two waits share what ends one of them only. Its own thread and
one that is free are enough: the others may run one after the other.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.generator.program_steps import NamedWait, WaitKind
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.verify.search.search_results import SLICE_STATES, Found, Search, key_of
from ros2cc_extract.verify.slices.slicer import Slicer
from ros2cc_extract.verify.slices.wait_relations import Names

_THREADS = 2


def prove_apart(
    slicer: Slicer, queries: Sequence[Query], search: Search, limits: Limits
) -> Found | None:
    """Prove of ``queries`` that callbacks end, where each of their waits ends."""
    found: Found | None = None
    served = _members(slicer.closed)  # threads have no slice of one wait
    limits = replace(limits, states=SLICE_STATES)
    for query in queries:
        if query.family is Family.PROGRESS and query.callbacks[0] in served:
            key = key_of(query)
            proven: Found | None = None
            for part in _parts(slicer, query.callbacks[0]):
                proven = None if part is None else search(part, [key], limits)
                if proven is None or proven.results[key].verdict is not Verdict.SATISFIED:
                    proven = None
                    break
            if proven is not None:
                results = {**(found.results if found else {}), **proven.results}
                found = Found(results, proven.check, len(results))
    return found


def _parts(slicer: Slicer, name: str) -> Iterator[ClosedSpec | None]:
    """Give a slice for each wait, in which it is the only one; ``None`` where one has more."""
    steps = tuple(waits_of(slicer.callback(name), slicer.closed.spec))
    origins = sorted({step.origin for step in steps})
    if len(origins) > 1 and slicer.waits_alone(name) and _are_apart(steps):
        for origin in origins:
            yield _with_one(slicer, name, tuple(s for s in steps if s.origin == origin))


def _are_apart(steps: Sequence[NamedWait]) -> bool:
    """Whether each is a plain wait, and none takes away what ends another one."""
    is_plain = all(s.kind is WaitKind.HELD and s.lock is None and not s.held for s in steps)
    shared = Counter({(s.resource, s.origin): 1 for s in steps if s.resource is not None})
    users = Counter(resource for resource, _ in shared)
    return is_plain and not any(r.is_each and number > 1 for r, number in users.items())


def _members(part: ClosedSpec) -> Names:
    return frozenset(callback.name for callback in part.spec.callbacks)


def _with_one(slicer: Slicer, name: str, steps: tuple[NamedWait, ...]) -> ClosedSpec | None:
    closed = slicer.closed
    callback = slicer.callback(name)
    alone = replace(callback, blocking=(callback.blocking[steps[0].origin],))
    callbacks = tuple(alone if c is callback else c for c in closed.spec.callbacks)
    unit = replace(closed, spec=replace(closed.spec, callbacks=callbacks))
    one = Slicer(unit, slicer.max_cycle)
    part = one.part_of_end(name)
    if part is None or one.by_request != slicer.by_request & _members(part):
        return None  # one that no other wait asks would run unasked
    own = next(c for c in part.spec.callbacks if c.name == name)
    if tuple(waits_of(own, part.spec)) != steps:
        return None
    executor = part.spec.executor
    executor = replace(executor, threads=executor.threads[:_THREADS])
    return replace(part, spec=replace(part.spec, executor=executor))
