"""
Looks for a run over states that others have named: one short search after the other.

What lies far from the start is found so where a search from there would see too much before. A
run over waypoints is one run of the model, so a claim that it refutes is refuted; a claim that
stands from the last waypoint on says nothing of other runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from ros2cc_extract.checker.engines.choice import choose
from ros2cc_extract.checker.engines.limits import Limits, peak_mb
from ros2cc_extract.checker.engines.search import NO_REDUCTIONS, Outcome, SearchResult, StatePath
from ros2cc_extract.checker.engines.terms import EngineKind, Fairness, Verdict
from ros2cc_extract.checker.network.network import Network
from ros2cc_extract.checker.network.semantics import Semantics, State
from ros2cc_extract.checker.runs.answers import Answer, CheckResult
from ros2cc_extract.checker.runs.replay import Replayer
from ros2cc_extract.checker.uppaal.files.query_file import Query
from ros2cc_extract.checker.uppaal.model import Model
from ros2cc_extract.source_locations import Place

_FROM_HERE = 'nothing refutes it from the last waypoint on'
_UNNAMED = Place('query', 1)


def refute(
    model: Model,
    waypoints: Sequence[str],
    queries: Sequence[Query],
    *,
    limits: Limits,
    engine: EngineKind = EngineKind.AUTO,
) -> CheckResult:
    """
    Go from waypoint to waypoint, and look for what refutes the queries from the last one on.

    :param waypoints: ``E<>`` queries; each is looked for from where the one before it held. One
        that is not to be had from there is left out.
    :param limits: of each search; nothing is refuted where one of them is hit.
    """
    search = _Search(model, limits, engine)
    path: tuple[State, ...] = (Semantics(model.network).initial(),)
    for waypoint in waypoints:
        found = search.from_state(path[-1], [waypoint])[0]
        if found.verdict is Verdict.UNDECIDED:
            reason = found.reason or ''
            return search.result_of([_open(query, reason) for query in queries])
        if found.path is not None:
            path = (*path, *found.path.states[1:])
    outcomes = search.from_state(path[-1], [query.formula for query in queries])
    replayer = Replayer(model.elaboration, model.network, Fairness.NONE)
    return search.result_of(
        [
            _answer(model, replayer, query, path, outcome)
            for query, outcome in zip(queries, outcomes, strict=True)
        ]
    )


def _open(query: Query, reason: str) -> Answer:
    return Answer(query=query, verdict=Verdict.UNDECIDED, reason=reason, seconds=0.0, replay=None)


def _answer(
    model: Model, replayer: Replayer, query: Query, path: tuple[State, ...], outcome: Outcome
) -> Answer:
    if outcome.verdict is not Verdict.NOT_SATISFIED or outcome.path is None:
        return _open(query, outcome.reason or _FROM_HERE)
    prop = model.elaboration.query(query.formula, query.place or _UNNAMED)
    cycle = outcome.path.cycle_start
    whole = StatePath(
        (*path, *outcome.path.states[1:]),
        None if cycle is None else cycle + len(path) - 1,
        outcome.path.end,
    )
    replayer.run(prop, whole, None)  # a verdict needs a run that shows it
    replay = partial(replayer.run, prop, whole, None)
    return Answer(
        query=query,
        verdict=outcome.verdict,
        reason=None,
        seconds=outcome.seconds,
        replay=replay,
    )


class _Search:
    """Searches of one model from several states."""

    def __init__(self, model: Model, limits: Limits, engine: EngineKind) -> None:
        self._model = model
        self._limits = limits
        self._engine = choose(engine)
        self._states = self._transitions = 0

    def from_state(self, state: State, formulas: Sequence[str]) -> Sequence[Outcome]:
        """Answer queries as if the model began in ``state``."""
        asked = [self._model.elaboration.query(formula, _UNNAMED) for formula in formulas]
        # Behind them: a query brings the functions that it alone calls.
        network = _beginning_in(state, self._model.network)
        result: SearchResult = self._engine.search(
            network,
            asked,
            limits=self._limits,
            fairness=Fairness.NONE,
            reductions=NO_REDUCTIONS,
            progress=None,
            jobs=1,
        )
        self._states += result.states
        self._transitions += result.transitions
        return result.outcomes

    def result_of(self, answers: Sequence[Answer]) -> CheckResult:
        """The answers, with what it took."""
        return CheckResult(
            engine=self._engine.name,
            states=self._states,
            transitions=self._transitions,
            seconds=0.0,
            peak_mb=peak_mb(),
            complete=False,
            answers=tuple(answers),
        )


def _beginning_in(state: State, network: Network) -> Network:
    locations, values = state.locations, state.values
    return replace(
        network,
        processes=tuple(
            replace(process, initial=place)
            for process, place in zip(network.processes, locations, strict=True)
        ),
        variables=tuple(
            replace(variable, initial=value)
            for variable, value in zip(network.variables, values, strict=True)
        ),
    )
