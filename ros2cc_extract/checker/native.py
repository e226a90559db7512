"""The native engine: calls the compiled core; only this module imports it."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ros2cc_extract.checker.dead import forget, forgettings
from ros2cc_extract.checker.interpret import endless_error, site_error
from ros2cc_extract.checker.limits import WITH_LASSOS, Limits, Progress, Watch
from ros2cc_extract.checker.nativecode import Lowering, Predicate
from ros2cc_extract.checker.network import Network, Property
from ros2cc_extract.checker.search import (
    INTERRUPTED,
    End,
    Fairness,
    Outcome,
    SearchResult,
    StatePath,
    formulas_of,
    found,
    goal_of,
    inside_of,
    not_found,
    positions,
)
from ros2cc_extract.checker.semantics import State

if TYPE_CHECKING:
    from ros2cc_extract.checker import _core

_ENDS = {1: End.DEADLOCK, 2: End.IDLE}


def search(
    network: Network,
    properties: Sequence[Property],
    *,
    limits: Limits,
    fairness: Fairness,
    reduction: bool,
    progress: Callable[[Progress], None] | None,
) -> SearchResult:
    """
    Answer all properties by one exploration in the core.

    :raises ModelFormatError: a reachable state breaks a range, an index or a loop bound.
    :raises ImportError: the core is not built.
    """
    from ros2cc_extract.checker import _core

    lowering = Lowering(network, _core.OPERATIONS)
    reachability = positions(properties, reachability=True)
    liveness = positions(properties, reachability=False)
    goals = [lowering.predicate(goal_of(properties[i])) for i in reachability]
    lassos = [_lasso(lowering, properties[i]) for i in liveness]
    reduce = None
    if reduction:
        forgotten = forgettings(network, formulas_of(properties))
        lowering.forget(forgotten)
        reduce = functools.partial(forget, forgotten)
    watching = _Watching(Watch(limits, progress, WITH_LASSOS if liveness else 1.0))
    try:
        result = _core.search(
            **vars(lowering.tables),
            goals=goals,
            lassos=lassos,
            is_fair=fairness is Fairness.WEAK,
            watch=watching,
        )
    except _core.CheckError as error:
        site, value = error.args
        raise site_error(network.sites[site], value) from None
    except _core.EndlessError as error:
        raise endless_error(network.functions[error.args[0]]) from None
    answers = _Answers(network, properties, watching)
    outcomes = dict(zip(reachability, map(answers.goal, reachability, result.goals), strict=True))
    outcomes |= zip(liveness, map(answers.lasso, liveness, result.lassos), strict=True)
    return SearchResult(
        result.states,
        result.transitions,
        watching.watch.seconds(),
        result.is_complete,
        tuple(outcomes[i] for i in range(len(properties))),
        reduce,
    )


def _lasso(lowering: Lowering, prop: Property) -> tuple[Predicate, Predicate | None]:
    start = lowering.predicate(prop.premise) if prop.premise is not None else None
    return lowering.predicate(inside_of(prop)), start


class _Watching:
    """What the core calls back: keeps the reason to stop, also a Ctrl-C."""

    def __init__(self, watch: Watch) -> None:
        self.watch = watch
        self.reason: str | None = None

    def __call__(self, states: int, transitions: int, more_bytes: int, is_exploring: bool) -> bool:
        try:
            if is_exploring:
                self.reason = self.watch.broken(states, transitions, more_bytes)
                return self.reason is not None
            late = INTERRUPTED if self.reason == INTERRUPTED else self.watch.exhausted()
            self.reason = self.reason or late
            return late is not None
        except KeyboardInterrupt:
            self.reason = INTERRUPTED
            return True


class _Answers:
    def __init__(
        self, network: Network, properties: Sequence[Property], watching: _Watching
    ) -> None:
        self._count = len(network.processes)
        self._properties = properties
        self._watching = watching

    def goal(self, index: int, answer: _core.Answer) -> Outcome:
        prop = self._properties[index]
        if answer.path:
            return found(prop, answer.seconds, self._path(answer))
        return not_found(prop, self._watching.watch.seconds(), self._watching.reason)

    def lasso(self, index: int, answer: _core.Answer) -> Outcome:
        prop, seconds = self._properties[index], self._watching.watch.seconds()
        if answer.path:
            return found(prop, seconds, self._path(answer))
        return not_found(prop, seconds, self._watching.reason)

    def _path(self, answer: _core.Answer) -> StatePath:
        states = tuple(
            State(tuple(raw[: self._count]), tuple(raw[self._count :])) for raw in answer.path
        )
        start = answer.cycle_start if answer.cycle_start >= 0 else None
        return StatePath(states, start, _ENDS.get(answer.end))
