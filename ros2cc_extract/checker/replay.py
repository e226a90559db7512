"""
Replays a path under the plain semantics before anybody sees it.

An engine returns states; the edges between them, the formulae along them and the way the path
ends are established here anew. A disagreement is a defect of this tool.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ros2cc_extract.checker.network import Expr, Network, Property, QueryKind
from ros2cc_extract.checker.run import EdgeRef, Naming, Run, Step
from ros2cc_extract.checker.search import End, Fairness, Reduce, StatePath
from ros2cc_extract.checker.semantics import Edges, Semantics, State, Transition
from ros2cc_extract.checker.uppaal.elaborate import Elaboration
from ros2cc_extract.checker.walks import mentions_deadlock
from ros2cc_extract.errors import CoreMismatchError

_MEND = 'please report this model: it is a defect of the checker'


@dataclass
class _RealPath:
    """States of the model and the moves between them; with a cycle the last state closes it."""

    states: list[State]
    moves: list[Transition]
    cycle_start: int | None
    end: End | None


class Replayer:
    """Replays the paths of one search."""

    def __init__(self, elaboration: Elaboration, network: Network, fairness: Fairness) -> None:
        self._network = network
        self._fairness = fairness
        self._semantics = Semantics(network)
        self._naming = Naming(elaboration, network)
        self._known: dict[State, list[Transition]] = {}
        self._steps: dict[tuple[State, State], list[Edges]] = {}

    def run(self, prop: Property, path: StatePath, reduce: Reduce | None) -> Run:
        """
        Return the path with its edges and names, in states of the model as it stands.

        :param reduce: what the search did to each state it reached; the path is in such states.
        :raises CoreMismatchError: the path is none of the model, or does not show what it should.
        """
        if path.states[0] != self._semantics.initial():
            raise _mismatch('it does not start in the initial state')
        states = list(path.states)
        if path.cycle_start is not None:
            states.append(states[path.cycle_start])
        moves = self._moves(states, path.cycle_start, reduce)
        real = self._walk(moves, path)
        self._check_formulas(prop, real)
        return self._told(real)

    def _successors(self, state: State) -> list[Transition]:
        # The paths of one search share most of their beginnings.
        if state not in self._known:
            self._known[state] = list(self._semantics.successors(state))
        return self._known[state]

    def _fitting(self, state: State, target: State, reduce: Reduce | None) -> list[Edges]:
        """Return the edges that lead from one state of the search to the next."""
        key = state, target
        if key not in self._steps:
            self._steps[key] = [
                t.edges
                for t in self._successors(state)
                if (reduce(t.target, t.edges) if reduce else t.target) == target
            ]
        if not self._steps[key]:
            raise _mismatch('one of its steps is no transition of the model')
        return self._steps[key]

    def _moves(
        self, states: Sequence[State], cycle_start: int | None, reduce: Reduce | None
    ) -> list[Edges]:
        """Return the edges between the states of a path, on a fair cycle serving everybody."""
        is_fair = cycle_start is not None and self._fairness is Fairness.WEAK
        unserved = set(range(len(self._network.processes))) if is_fair else set()
        moves: list[Edges] = []
        for index, state in enumerate(states[:-1]):
            fitting = self._fitting(state, states[index + 1], reduce)
            if cycle_start is not None and index >= cycle_start:
                leaving = self._successors(state)
                unserved &= {process for t in leaving for process, _ in t.edges}
            moves.append(max(fitting, key=lambda edges: len({p for p, _ in edges} & unserved)))
            if cycle_start is not None and index >= cycle_start:
                unserved -= {process for process, _ in moves[-1]}
        if unserved:
            raise _mismatch('its cycle is not fair to every process')
        return moves

    def _walk(self, moves: Sequence[Edges], path: StatePath) -> _RealPath:
        """
        Take the moves from the initial state.

        After one round of a cycle, values that nobody reads may differ from those at its start;
        so rounds are added until a round ends where one began.
        """
        real = _RealPath([self._semantics.initial()], [], None, path.end)
        stem = len(moves) if path.cycle_start is None else path.cycle_start
        self._extend(real, moves[:stem])
        if path.cycle_start is None:
            return real
        begun: dict[State, int] = {}
        while real.states[-1] not in begun:
            begun[real.states[-1]] = len(real.states) - 1
            self._extend(real, moves[stem:])
        real.cycle_start = begun[real.states[-1]]
        return real

    def _extend(self, real: _RealPath, moves: Sequence[Edges]) -> None:
        for edges in moves:
            taken = [t for t in self._successors(real.states[-1]) if t.edges == edges]
            if not taken:
                raise _mismatch('one of its steps is not enabled')
            real.moves.append(taken[0])
            real.states.append(taken[0].target)

    # -- what the path should show -------------------------------------------------------
    def _holds(self, formula: Expr, state: State) -> bool:
        is_deadlock = mentions_deadlock(formula) and not self._successors(state)
        return bool(self._semantics.evaluate(formula, state, is_deadlock))

    def _check_formulas(self, prop: Property, path: _RealPath) -> None:
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

    def _premise_index(self, prop: Property, path: _RealPath) -> int:
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

    def _check_end(self, path: _RealPath) -> None:
        if path.cycle_start is not None:
            return
        last = path.states[-1]
        is_stuck = not self._successors(last)
        if path.end is End.DEADLOCK and is_stuck:
            return
        may_stay = self._fairness is Fairness.NONE and self._semantics.may_idle(last)
        if path.end is End.IDLE and may_stay:
            return
        raise _mismatch('it does not end as a maximal path')

    # -- names ---------------------------------------------------------------------------
    def _told(self, real: _RealPath) -> Run:
        steps = tuple(
            self._step(state, move) for state, move in zip(real.states, real.moves, strict=False)
        )
        end = real.end.value if real.end else None
        return Run(self._naming.view(real.states[0]), steps, real.cycle_start, end)

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
