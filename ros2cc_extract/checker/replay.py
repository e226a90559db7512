"""
Replays a path under the plain semantics before anybody sees it.

An engine returns states; the edges between them, the formulae along them and the way the path
ends are established here anew. A disagreement is a defect of this tool.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.checker.network import Expr, Network, Property, QueryKind
from ros2cc_extract.checker.run import EdgeRef, Naming, Run, Step
from ros2cc_extract.checker.search import End, Fairness, StatePath
from ros2cc_extract.checker.semantics import Semantics, State, Transition
from ros2cc_extract.checker.uppaal.elaborate import Elaboration
from ros2cc_extract.errors import CoreMismatchError

_MEND = 'please report this model: it is a defect of the checker'


class Replayer:
    """Replays the paths of one search."""

    def __init__(self, elaboration: Elaboration, network: Network, fairness: Fairness) -> None:
        self._network = network
        self._fairness = fairness
        self._semantics = Semantics(network)
        self._naming = Naming(elaboration, network)

    def run(self, prop: Property, path: StatePath) -> Run:
        """
        Return the path with its edges and names.

        :raises CoreMismatchError: the path is none of the model, or does not show what it should.
        """
        if path.states[0] != self._semantics.initial():
            raise _mismatch('it does not start in the initial state')
        states = list(path.states)
        if path.cycle_start is not None:
            states.append(states[path.cycle_start])
        moves = [self._move(states[i], states[i + 1]) for i in range(len(states) - 1)]
        if path.cycle_start is not None and self._fairness is Fairness.WEAK:
            moves = self._fair_moves(states, moves, path.cycle_start)
        self._check_formulas(prop, path)
        steps = tuple(
            self._step(state, move) for state, move in zip(states, moves, strict=False)
        )
        end = path.end.value if path.end else None
        return Run(self._naming.view(states[0]), steps, path.cycle_start, end)

    def _move(self, state: State, target: State) -> Transition:
        for transition in self._semantics.successors(state):
            if transition.target == target:
                return transition
        raise _mismatch('one of its steps is no transition of the model')

    # -- what the path should show -------------------------------------------------------
    def _holds(self, formula: Expr, state: State) -> bool:
        return bool(self._semantics.evaluate(formula, state))

    def _check_formulas(self, prop: Property, path: StatePath) -> None:
        last = path.states[-1]
        if prop.kind in (QueryKind.INVARIANT, QueryKind.REACHABLE):
            if self._holds(prop.formula, last) is (prop.kind is QueryKind.INVARIANT):
                raise _mismatch('its last state does not decide the query')
            return
        self._check_end(path)
        inside = prop.kind is QueryKind.POSSIBLY_ALWAYS
        begin = self._premise_index(prop, path)
        if any(self._holds(prop.formula, state) is not inside for state in path.states[begin:]):
            raise _mismatch('it leaves the states it should stay in')

    def _premise_index(self, prop: Property, path: StatePath) -> int:
        """Return from where on a leads-to counterexample must avoid the conclusion."""
        if prop.premise is None:
            return 0
        latest = len(path.states) - 1 if path.cycle_start is None else path.cycle_start
        for index in range(latest, -1, -1):
            if self._holds(prop.formula, path.states[index]):
                break
            if self._holds(prop.premise, path.states[index]):
                return index
        raise _mismatch('its premise does not hold before it')

    def _check_end(self, path: StatePath) -> None:
        if path.cycle_start is not None:
            return
        last = path.states[-1]
        is_stuck = next(self._semantics.successors(last), None) is None
        if path.end is End.DEADLOCK and is_stuck:
            return
        may_stay = self._fairness is Fairness.NONE and self._semantics.may_idle(last)
        if path.end is End.IDLE and may_stay:
            return
        raise _mismatch('it does not end as a maximal path')

    def _fair_moves(
        self, states: Sequence[State], moves: list[Transition], cycle_start: int
    ) -> list[Transition]:
        """Choose among parallel transitions so that every process is served on the cycle."""
        unserved = set(range(len(self._network.processes)))
        for index in range(cycle_start, len(moves)):
            parallel = list(self._semantics.successors(states[index]))
            enabled = {process for t in parallel for process, _ in t.edges}
            unserved &= enabled
            same = [t for t in parallel if t.target == states[index + 1]]
            best = max(same, key=lambda t: len({p for p, _ in t.edges} & unserved))
            moves[index] = best
            unserved -= {process for process, _ in best.edges}
        if unserved:
            raise _mismatch('its cycle is not fair to every process')
        return moves

    # -- names ---------------------------------------------------------------------------
    def _step(self, state: State, move: Transition) -> Step:
        sync = self._semantics.edge(move.edges[0]).sync
        channel = None
        if sync is not None:
            number = self._semantics.channel(self._semantics.edge(move.edges[0]), state)
            channel = self._network.channels[number].name
        edges = tuple(self._edge(process, number, channel) for process, number in move.edges)
        return Step(edges, self._naming.view(move.target))

    def _edge(self, process: int, number: int, channel: str | None) -> EdgeRef:
        owner = self._network.processes[process]
        edge = owner.edges[number]
        return EdgeRef(
            process=owner.name,
            template=owner.template,
            source=owner.locations[edge.source].name,
            target=owner.locations[edge.target].name,
            channel=channel,
            comment=edge.comment,
            select=dict(edge.select),
            place=edge.place,
        )


def _mismatch(what: str) -> CoreMismatchError:
    text = f'the path that the search found cannot be replayed: {what}'
    return CoreMismatchError(text, None, _MEND)
