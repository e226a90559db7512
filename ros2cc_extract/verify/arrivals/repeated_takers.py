"""
Who takes what each wait uses up, from somebody who may not give it once more.

With one arrival for each callback a wait of the second run does not exist: what one run gave
serves the one run that takes. A timer that takes from a queue each period, and another that puts
into it once, need a run more than there are signals.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.generator.build import Family
from ros2cc_extract.generator.program_steps import NamedWait
from ros2cc_extract.generator.resources import Actor, all_actors
from ros2cc_extract.generator.waits import waits_of
from ros2cc_extract.spec.effects import ENDLESS_LOOP, WORKING_LOOP
from ros2cc_extract.spec.model import Activity, Callback, CallbackType, EntityKind, Spec
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import Key

#: So many runs of one callback, as each costs states; more signals are given by few programs.
MOST_RUNS = 8


def taking_again(spec: Spec, results: Mapping[Key, QueryResult]) -> Mapping[str, int]:
    """
    Give the callbacks that need more than one run to use up what there is, and how many.

    A wait that a branch may skip is left at one: what it asks before may keep it from the rest.
    """
    runs = {c.name: _runs(c, spec, results) for c in spec.callbacks if not c.one_shot}
    return {name: number for name, number in runs.items() if number > 1}


def _runs(callback: Callback, spec: Spec, results: Mapping[Key, QueryResult]) -> int:
    needed = (_given(wait, spec, results) + 1 for wait in _takes(callback, spec))
    return min(max(needed, default=1), MOST_RUNS)


def _takes(callback: Callback, spec: Spec) -> Iterator[NamedWait]:
    for wait in waits_of(callback, spec):
        is_each = wait.resource is not None and wait.resource.is_each and not wait.is_signal
        if is_each and wait.block is not None and not wait.block.conditional:
            yield wait


def _given(wait: NamedWait, spec: Spec, results: Mapping[Key, QueryResult]) -> int:
    """Count the signals that may be the last ones; none where others surely follow."""
    doers = {doer.name: doer for doer in all_actors(spec)}
    wakers = wait.block.wakers if wait.block is not None else ()
    for waker in wakers:
        giver = doers.get(waker.by)
        if giver is None or (not waker.conditional and _gives_again(giver, results)):
            return 0
    return len(wakers)


def _gives_again(giver: Actor, results: Mapping[Key, QueryResult]) -> bool:
    """Whether it runs as often as somebody needs it, and always comes to its end."""
    if any(block.call in (ENDLESS_LOOP, WORKING_LOOP) for block in giver.blocking):
        return True  # it may give in each round
    result = results.get((Family.PROGRESS, (giver.name,), ()))
    if result is not None and result.verdict is not Verdict.SATISFIED:
        return False
    return giver.loops if isinstance(giver, Activity) else _comes_by_itself(giver)


def _comes_by_itself(callback: Callback) -> bool:
    is_task = callback.entity is not None and callback.entity.is_task
    is_asked = callback.type is CallbackType.CLT or callback.entity is EntityKind.ACTION_CLIENT
    return not (callback.one_shot or is_task or is_asked)
