"""The native engine: calls the compiled core; only this module imports it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from ros2cc_extract.checker.analyses.canonical_states import Reducer
from ros2cc_extract.checker.analyses.dead_variables import forgettings
from ros2cc_extract.checker.engines.interrupts import noted
from ros2cc_extract.checker.engines.limits import (
    WITH_LASSOS,
    Limits,
    Progress,
    Watch,
    states_reason,
)
from ros2cc_extract.checker.engines.native_tables import Lowering, Predicate
from ros2cc_extract.checker.engines.search import (
    INTERRUPTED,
    End,
    Outcome,
    Reductions,
    SearchResult,
    StatePath,
    Symmetry,
    formulas_of,
    found,
    goal_of,
    inside_of,
    not_found,
    positions,
)
from ros2cc_extract.checker.engines.terms import Fairness
from ros2cc_extract.checker.network.interpreter import endless_error, site_error
from ros2cc_extract.checker.network.network import Network, Property
from ros2cc_extract.checker.network.semantics import State

if TYPE_CHECKING:
    from ros2cc_extract.checker import _core
    from ros2cc_extract.checker.analyses.symmetry import Family

#: More than the core can number.
MAX_STATES = 2**63
_ENDS = {1: End.DEADLOCK, 2: End.IDLE}


def search(
    network: Network,
    properties: Sequence[Property],
    *,
    limits: Limits,
    fairness: Fairness,
    reductions: Reductions,
    progress: Callable[[Progress], None] | None,
    jobs: int,
) -> SearchResult:
    """
    Answer all properties by one exploration in the core.

    :raises ModelFormatError: a reachable state breaks a range, an index or a loop bound.
    :raises ImportError: the core is not built.
    """
    question = _Question(network, properties, limits, fairness, reductions, progress, jobs)
    if reductions.symmetry is Symmetry.NEVER:
        return question.answer(limits.states)
    if reductions.symmetry is Symmetry.ALWAYS:
        return question.answer_by_symmetry() or question.answer(limits.states)
    is_small = limits.states is not None and limits.states <= SYMMETRY_PAYS_FROM
    found = question.answer(limits.states if is_small else SYMMETRY_PAYS_FROM)
    if is_small or not question.is_full:
        return found
    return question.answer_by_symmetry() or question.answer(limits.states)


#: States that are explored before families are looked for, which takes longer than these states.
SYMMETRY_PAYS_FROM = 20_000

#: States from which several threads explore together, and how many threads at most.
JOBS_PAY_FROM = 100_000
MOST_JOBS = 64


class _Question:
    """
    One question to the core, which may be asked in several ways.

    :param is_full: whether the last answer ended at its number of states.
    """

    def __init__(
        self,
        network: Network,
        properties: Sequence[Property],
        limits: Limits,
        fairness: Fairness,
        reductions: Reductions,
        progress: Callable[[Progress], None] | None,
        jobs: int,
    ) -> None:
        from ros2cc_extract.checker import _core

        self.is_full = False
        self._core = _core
        self._network, self._properties, self._limits = network, properties, limits
        self._fairness, self._jobs = fairness, jobs
        self._reachability = positions(properties, reachability=True)
        self._liveness = positions(properties, reachability=False)
        self._lowering = Lowering(network, _core.OPERATIONS)
        lowered = self._lowering.predicate
        self._goals = [lowered(goal_of(properties[i])) for i in self._reachability]
        self._lassos = [_lasso(self._lowering, properties[i]) for i in self._liveness]
        formulas = formulas_of(properties)
        self._forgotten = forgettings(network, formulas) if reductions.dead else ()
        if self._forgotten:
            self._lowering.forget(self._forgotten)
        may_run = reductions.chains and not self._liveness and jobs == 1
        self._runs_chains = may_run and has_chains(network)
        self._families: tuple[Family, ...] = ()
        share = WITH_LASSOS if self._liveness else 1.0
        self._watching = _Watching(Watch(limits, progress, share))

    def answer_by_symmetry(self) -> SearchResult | None:
        """Return the answer, None where there is no symmetry or it breaks on the way."""
        if self._fairness is Fairness.WEAK and self._liveness:
            return None  # a cycle that is fair to like processes in turn need not be to each
        # Imported late: few searches grow that large.
        from ros2cc_extract.checker.analyses.symmetry import families

        self._families = families(self._network, formulas_of(self._properties))
        if not self._families:
            return None
        self._lowering.order(self._families, self._forgotten)
        try:
            return self.answer(self._limits.states)
        except self._core.UnevenError:
            return None
        finally:
            self._families = ()
            self._lowering.order((), ())

    def answer(self, max_states: int | None) -> SearchResult:
        """Return the answer; families are as they were set."""
        watching = self._watching
        watching.reason = None
        try:
            with noted(watching.interrupt):
                result = self._core.search(
                    **vars(self._lowering.tables),
                    goals=self._goals,
                    lassos=self._lassos,
                    is_fair=self._fairness is Fairness.WEAK,
                    runs_chains=self._runs_chains,
                    max_states=MAX_STATES if max_states is None else min(max_states, MAX_STATES),
                    jobs=(min(self._jobs, MOST_JOBS), JOBS_PAY_FROM),
                    watch=watching,
                )
        except self._core.CheckError as error:
            site, value = error.args
            raise site_error(self._network.sites[site], value) from None
        except self._core.EndlessError as error:
            raise endless_error(self._network.functions[error.args[0]]) from None
        self.is_full = result.is_full
        if result.is_full:
            watching.reason = watching.reason or states_reason(max_states)
        return self._converted(result)

    def _converted(self, result: _core.Result) -> SearchResult:
        answers = _Answers(self._network, self._properties, self._watching)
        reached = map(answers.goal, self._reachability, result.goals)
        outcomes = dict(zip(self._reachability, reached, strict=True))
        outcomes |= zip(
            self._liveness, map(answers.lasso, self._liveness, result.lassos), strict=True
        )
        is_plain = not (self._forgotten or self._families or self._runs_chains)
        return SearchResult(
            result.states,
            result.transitions,
            self._watching.watch.seconds(),
            result.is_complete,
            tuple(outcomes[i] for i in range(len(self._properties))),
            None if is_plain else Reducer(self._network, self._forgotten, self._families),
        )


def has_chains(network: Network) -> bool:
    """Whether there is a committed location."""
    return any(at.is_committed for process in network.processes for at in process.locations)


def _lasso(lowering: Lowering, prop: Property) -> tuple[Predicate, Predicate | None]:
    start = lowering.predicate(prop.premise) if prop.premise is not None else None
    return lowering.predicate(inside_of(prop)), start


class _Watching:
    """What the core calls back: keeps the reason to stop, also a Ctrl-C."""

    def __init__(self, watch: Watch) -> None:
        self.watch = watch
        self.reason: str | None = None
        self._is_interrupted = False

    def interrupt(self) -> None:
        """End the search when the core asks next."""
        self._is_interrupted = True

    def __call__(self, states: int, transitions: int, more_bytes: int, is_exploring: bool) -> bool:
        if self._is_interrupted:
            self.reason = INTERRUPTED
            return True
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
