"""
A last look at waits that end by themselves a number of times: with runs enough to use them up.

The value of a semaphore and the room in a bounded queue are used up by runs before. A model of
one arrival for each has none, so it leaves such a wait open, and claims stay in doubt. Here data
arrives so often that they are used up in the run itself, as far as a doer takes more than is
given back. What such a run refutes is refuted; all else stays as it was.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.checker.api import Limits, Verdict
from ros2cc_extract.generator.build import Query
from ros2cc_extract.generator.resources import FOR_RUNS, Actor, all_actors
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import BY_ITSELF, Blocking, Needs
from ros2cc_extract.spec.model import Activity, Spec
from ros2cc_extract.verify.arrivals.filled_threads import OF_ENDS
from ros2cc_extract.verify.arrivals.needed_arrivals import crowding
from ros2cc_extract.verify.search.search_results import Found, Key, key_of, total

#: Loops that go round more often are not counted.
MOST_ROUNDS = 8
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
    waits: dict[str, list[tuple[Blocking, Actor]]] = {}
    for actor in all_actors(spec):
        for block in actor.blocking:
            if block.resource is not None and block.initial and block.seconds is None:
                waits.setdefault(block.resource, []).append((block, actor))
    return {
        name: own[0][0].initial
        for name, own in waits.items()
        if all(_is_counted(block, actor, spec) for block, actor in own)
    }


def _is_counted(block: Blocking, actor: Actor, spec: Spec) -> bool:
    """Of a loop only where nothing else that others see happens in its rounds."""
    why = block.escapes
    if why is None or not why.reason.endswith(BY_ITSELF) or block.times > MOST_ROUNDS:
        return False
    if block.times == 1:
        return True
    in_loops = [each for each in actor.blocking if each.times > 1]
    return in_loops == [block] and not block.repeats and not _does_for_others(actor, spec)


def _does_for_others(actor: Actor, spec: Spec) -> bool:
    """Whether it ends a wait or starts a thread."""
    blocks = (block for each in all_actors(spec) for block in each.blocking)
    wakers = [waker for block in blocks for waker in block.wakers]
    starts = [start for activity in spec.activities for start in activity.starts]
    return any(each.by == actor.name for each in (*wakers, *starts))


def _with_counts(spec: Spec, most: Mapping[str, int]) -> Spec:
    return replace(
        spec,
        callbacks=tuple(replace(c, blocking=_blocks(c, spec, most)) for c in spec.callbacks),
        activities=tuple(replace(a, blocking=_blocks(a, spec, most)) for a in spec.activities),
    )


def _blocks(actor: Actor, spec: Spec, most: Mapping[str, int]) -> tuple[Blocking, ...]:
    blocks: list[Blocking] = []
    for block in actor.blocking:
        if block.resource in most and block.initial > 0:
            blocks += [replace(block, counted=True, escapes=None)] * block.times
        elif _is_of_each_run(block, actor, spec):
            blocks.append(replace(block, needs=Needs.EACH))
        else:
            blocks.append(block)
    return tuple(blocks)


def _is_of_each_run(block: Blocking, actor: Actor, spec: Spec) -> bool:
    """Whether each run of ``actor`` starts what it waits for the end of, and nothing else does."""
    if block.call not in FOR_RUNS or block.needs is not Needs.ONCE or not block.wakers:
        return False
    waiting = [b for a in all_actors(spec) for b in a.blocking if b.resource == block.resource]
    started = {activity.name: activity.starts for activity in spec.activities}
    starts = [start for waker in block.wakers for start in started.get(waker.by, ())]
    by_itself = bool(starts) and all(start.by == actor.name for start in starts)
    return by_itself and waiting == [block] and len(block.wakers) == 1


def _arrivals(closed: ClosedSpec, runs: int) -> dict[str, int]:
    """So many for each, also for what asks or starts the takers, and then those of a crowd."""
    arrivals = {}
    crowds = crowding(closed.spec)
    for actor in all_actors(closed.spec):
        if isinstance(actor, Activity) or not actor.one_shot:
            arrivals[actor.name] = runs - 1 + crowds.get(actor.name, 1)
    return arrivals
