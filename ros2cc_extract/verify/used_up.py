"""
A last look at waits that end by themselves a number of times: with runs enough to use them up.

The value of a semaphore and the room in a bounded queue are used up by runs before. A model of
one arrival for each has none, so it leaves such a wait open, and claims stay in doubt. Here data
arrives so often that they are used up in the run itself, as far as somebody takes more than is
given back. What such a run refutes is refuted; all else stays as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Query
from ros2cc_extract.generator.resources import Actor, all_actors
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.deeds import BY_ITSELF, Blocking
from ros2cc_extract.spec.model import Activity, Spec
from ros2cc_extract.verify.again import OF_ENDS
from ros2cc_extract.verify.asking import Found, Key, key_of, total

Refute = Callable[[ClosedSpec, Sequence[Key], Limits], Found]


def refute_by_using_up(
    found: Found, queries: Sequence[Query], closed: ClosedSpec, refute: Refute, limits: Limits
) -> Found:
    """Refute what is open of ends by runs in which what there was at first is used up."""
    asked = [key_of(query) for query in queries if query.family in OF_ENDS]
    left = [key for key in asked if found.results[key].verdict is Verdict.UNDECIDED]
    most = _counted(closed.spec)
    if not left or not most or limits.is_over:
        return found
    spec = _with_counts(closed.spec, most)
    arrivals = _arrivals(closed, max(most.values()) + 1)
    part = refute(replace(closed, spec=spec, arrivals=arrivals), left, limits)
    repeated = tuple(arrivals)
    refuted = {
        key: replace(result, repeated=repeated)
        for key, result in part.results.items()
        if not result.in_doubt
    }
    return Found({**found.results, **refuted}, total((found.check, part.check)), found.by_slices)


def _counted(spec: Spec) -> Mapping[str, int]:
    """What is there at first of each resource of which nothing else is in doubt."""
    waits: dict[str, list[Blocking]] = {}
    for actor in all_actors(spec):
        for block in actor.blocking:
            if block.resource is not None and block.initial and block.seconds is None:
                waits.setdefault(block.resource, []).append(block)
    return {name: own[0].initial for name, own in waits.items() if all(map(_is_counted, own))}


def _is_counted(block: Blocking) -> bool:
    """How often a loop goes round a model does not have."""
    why = block.escapes
    return why is not None and why.reason.endswith(BY_ITSELF) and block.times == 1


def _with_counts(spec: Spec, most: Mapping[str, int]) -> Spec:
    return replace(
        spec,
        callbacks=tuple(replace(c, blocking=_blocks(c, most)) for c in spec.callbacks),
        activities=tuple(replace(a, blocking=_blocks(a, most)) for a in spec.activities),
    )


def _blocks(actor: Actor, most: Mapping[str, int]) -> tuple[Blocking, ...]:
    return tuple(
        replace(block, counted=True, escapes=None)
        if block.resource in most and block.initial > 0
        else block
        for block in actor.blocking
    )


def _arrivals(closed: ClosedSpec, runs: int) -> dict[str, int]:
    """So many for each, also for who asks or starts those who take."""
    arrivals = {}
    for actor in all_actors(closed.spec):
        if isinstance(actor, Activity) or not actor.one_shot:
            arrivals[actor.name] = max(runs, closed.arrivals.get(actor.name, 1))
    return arrivals
