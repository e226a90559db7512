"""
Runs that another program printed, found again among the transitions of a model.

Such a run names locations and variables and may leave some out. It is walked through the plain
semantics and then replayed like a path of our own, before it is shown.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ros2cc_extract.checker.engines.search import End, StatePath
from ros2cc_extract.checker.engines.terms import Fairness
from ros2cc_extract.checker.network.network import Network, QueryKind
from ros2cc_extract.checker.network.semantics import Semantics, State
from ros2cc_extract.checker.runs.replay import Replayer
from ros2cc_extract.checker.runs.run import Run
from ros2cc_extract.checker.uppaal.files.query_file import Query
from ros2cc_extract.checker.uppaal.model import Model
from ros2cc_extract.errors import InputError
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_MEND = 'the run must be one of this very model and query'


@dataclass(frozen=True)
class NamedState:
    """
    What was printed of a state.

    :param locations: name of the location by process.
    :param variables: by name, as ``group_closed[0]`` and ``executor.cur_cb_id``; names that the
        model has no variable for, such as clocks, do no harm.
    """

    locations: Mapping[str, str]
    variables: Mapping[str, int]


def replay_named(
    model: Model,
    query: Query,
    states: Sequence[NamedState],
    source: Place,
    fairness: Fairness = Fairness.NONE,
) -> Run:
    """
    Find a printed run in the model and replay it.

    :param states: the initial one first; a cycle ends with the state it began with.
    :param source: where the run was printed, for messages.
    :raises InputError: the model has no such run.
    :raises CoreMismatchError: it does not show what the query asks for.
    """
    network = model.network
    semantics = Semantics(network)
    found = _walk(semantics, _Matcher(network), states, source)
    prop = model.elaboration.query(query.formula, query.place or source)
    path = StatePath(tuple(found))
    if prop.kind not in (QueryKind.INVARIANT, QueryKind.REACHABLE):
        path = _endless(semantics, found, source)
    return Replayer(model.elaboration, network, fairness).run(prop, path, None)


def where_time_passes(model: Model, states: Sequence[NamedState]) -> tuple[bool, ...]:
    """Say of each state, fully named, whether time may pass in it."""
    network = model.network
    semantics, matcher = Semantics(network), _Matcher(network)
    return tuple(semantics.may_idle(matcher.state(named)) for named in states)


class _Matcher:
    """Compares states with what was printed of them."""

    def __init__(self, network: Network) -> None:
        self._locations = {
            process.name: (number, {at.name: i for i, at in enumerate(process.locations)})
            for number, process in enumerate(network.processes)
        }
        self._variables = {v.name: number for number, v in enumerate(network.variables)}

    def state(self, named: NamedState) -> State:
        """Give the state itself; every location and variable must be named."""
        locations = (places[named.locations[p]] for p, (_, places) in self._locations.items())
        return State(tuple(locations), tuple(named.variables[name] for name in self._variables))

    def fits(self, state: State, named: NamedState) -> bool:
        for process, location in named.locations.items():
            number, locations = self._locations.get(process, (-1, {}))
            if number < 0 or state.locations[number] != locations.get(location):
                return False
        return all(
            state.values[self._variables[name]] == value
            for name, value in named.variables.items()
            if name in self._variables
        )


def _walk(
    semantics: Semantics, matcher: _Matcher, states: Sequence[NamedState], source: Place
) -> list[State]:
    initial = semantics.initial()
    if not states or not matcher.fits(initial, states[0]):
        raise InputError('the run does not begin in the initial state', source, _MEND)
    # What was left out may leave a choice: all states that fit, each with the one before it.
    layers: list[dict[State, State]] = [{initial: initial}]
    for number, named in enumerate(states[1:], start=1):
        layer: dict[State, State] = {}
        for state in layers[-1]:
            for move in semantics.successors(state):
                if matcher.fits(move.target, named):
                    layer.setdefault(move.target, state)
        if not layer:
            raise InputError(f'step {number} is no transition of the model', source, _MEND)
        layers.append(layer)
    found = [next(iter(layers[-1]))]
    for layer in reversed(layers[1:]):
        found.append(layer[found[-1]])
    return found[::-1]


def _endless(semantics: Semantics, states: list[State], source: Place) -> StatePath:
    """Return how a run ends that should go on forever."""
    last = states[-1]
    if last in states[:-1]:
        return StatePath(tuple(states[:-1]), cycle_start=states.index(last))
    if not any(True for _ in semantics.successors(last)):
        return StatePath(tuple(states), end=End.DEADLOCK)
    if semantics.may_idle(last):
        return StatePath(tuple(states), end=End.IDLE)
    raise InputError('the run stops where it could go on', source, 'its last state shows no cycle')
