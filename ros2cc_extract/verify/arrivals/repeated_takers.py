"""
Callbacks that take what each wait uses up, from a giver that may not give it once more.

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
from ros2cc_extract.spec.display_names import display_names
from ros2cc_extract.spec.effects import ENDLESS_LOOP, WORKING_LOOP, Waker
from ros2cc_extract.spec.model import Activity, Callback, CallbackType, EntityKind, Spec
from ros2cc_extract.verify.results.results import QueryResult
from ros2cc_extract.verify.search.search_results import Key

#: So many runs of one callback, as each costs states; more signals are given by few programs.
MOST_RUNS = 8


def taking_again(spec: Spec, results: Mapping[Key, QueryResult]) -> Mapping[str, int]:
    """Give the callbacks that need more than one run to use up what there is, and how many."""
    runs: dict[str, int] = {}
    for callback, wait, needed in _takers(spec, results):
        if wait.block is not None and not wait.block.conditional:
            runs[callback.name] = min(max(needed, runs.get(callback.name, 1)), MOST_RUNS)
    return runs


def not_looked_at(spec: Spec, results: Mapping[Key, QueryResult]) -> str:
    """
    Say which runs that use up what there is no number of arrivals shows; empty where all are.

    Of a wait that a branch may skip, what it asks before may keep it from the rest.
    """
    names = display_names(spec)
    for callback, wait, needed in _takers(spec, results):
        if wait.block is None:
            continue
        who = names.get(callback.name, callback.name)
        used = f'each {wait.block.call} of {who} uses up what is given'
        if wait.block.conditional:
            return f'{used} a limited number of times, and data decides which of its runs do so'
        if needed > MOST_RUNS:
            return f'{used} {needed - 1} times, and {MOST_RUNS} of its runs are looked at'
    return next(_given_no_more(spec, names), '')


def _given_no_more(spec: Spec, names: Mapping[str, str]) -> Iterator[str]:
    """Say what takes the things of a thread whose loop a callback may have ended by then."""
    threads = {thread.name: thread for thread in spec.activities}
    for callback in spec.callbacks:
        for wait in waits_of(callback, spec):
            block = wait.block
            if block is None or wait.is_signal or block.seconds is not None or block.escapes:
                continue
            ends = [_end_of_loop(threads.get(waker.by), waker, spec) for waker in block.wakers]
            if ends and ends[0] is not None and None not in ends:
                what = f'{block.call} of {names.get(callback.name, callback.name)}'
                giver = block.wakers[0].by
                yield (
                    f'{names.get(giver, giver)} gives nothing more to {what} once '
                    f'{names.get(ends[0], ends[0])} has ended its loop'
                )


def _end_of_loop(thread: Activity | None, waker: Waker, spec: Spec) -> str | None:
    """Return the callback that ends the loop of ``thread`` in which it does what ends the wait."""
    callbacks = {callback.name for callback in spec.callbacks}
    for number, block in enumerate(thread.blocking if thread is not None else ()):
        if block.call == WORKING_LOOP and waker.after is not None and waker.after <= number:
            return next((each.by for each in block.wakers if each.by in callbacks), None)
    return None


def _takers(
    spec: Spec, results: Mapping[Key, QueryResult]
) -> Iterator[tuple[Callback, NamedWait, int]]:
    """Return what takes what may not be given once more, and in how many runs it is used up."""
    for callback in spec.callbacks:
        for wait in () if callback.one_shot else waits_of(callback, spec):
            is_each = wait.resource is not None and wait.resource.is_each and not wait.is_signal
            if is_each and (given := _given(wait, spec, results)):
                yield callback, wait, given + 1


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
    """Whether it runs as often as it is needed, and always comes to its end."""
    if any(block.call in (ENDLESS_LOOP, WORKING_LOOP) for block in giver.blocking):
        return True  # it may give in each round
    result = results.get((Family.PROGRESS, (giver.name,), ()))
    if result is not None and result.verdict is not Verdict.SATISFIED:
        return False
    return giver.loops is True if isinstance(giver, Activity) else _comes_by_itself(giver)


def _comes_by_itself(callback: Callback) -> bool:
    is_task = callback.entity is not None and callback.entity.is_task
    is_asked = callback.type is CallbackType.CLT or callback.entity is EntityKind.ACTION_CLIENT
    return not (callback.one_shot or is_task or is_asked)
