"""
Replay a path under the plain semantics before it is shown.

An engine returns states; the edges between them, the formulae along them and the way the path
ends are established here anew. A disagreement is a defect of this tool.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field

from ros2cc_extract.checker.engines.search import End, Reduce, StatePath
from ros2cc_extract.checker.engines.terms import Fairness
from ros2cc_extract.checker.network.network import Expr, Network, Property, QueryKind
from ros2cc_extract.checker.network.semantics import Edges, Semantics, State, Transition
from ros2cc_extract.checker.network.traversal import mentions_deadlock
from ros2cc_extract.checker.runs.run import EdgeRef, Naming, Run, Step
from ros2cc_extract.checker.uppaal.elaboration.elaborate import Elaboration
from ros2cc_extract.errors import CoreMismatchError
from ros2cc_extract.light_dataclasses import dataclass

_MEND = 'please report this model: it is a defect of the checker'


@dataclass
class _RealPath:
    """States of the model and the moves between them; with a cycle the last state closes it."""

    states: list[State]
    end: End | None
    moves: list[Transition] = field(default_factory=list)
    cycle_start: int | None = None


#: Edges, and the state of the search that they lead to, before like processes are ordered.
_Move = tuple[Edges, State]


class _Walk:
    """Goes along a path in the states of the search and those of the model at once."""

    def __init__(self, searched: State, real: State, end: End | None) -> None:
        self.searched = searched
        self.real = _RealPath([real], end)


class Replayer:
    """Replays the paths of one search."""

    def __init__(self, elaboration: Elaboration, network: Network, fairness: Fairness) -> None:
        self._network = network
        self._fairness = fairness
        self._semantics = Semantics(network)
        self._naming = Naming(elaboration, network)
        self._known: dict[State, list[Transition]] = {}
        self._steps: dict[tuple[State, State], list[_Move]] = {}

    def run(self, prop: Property, path: StatePath, reduce: Reduce | None) -> Run:
        """
        Return the path with its edges and names, in states of the model as it stands.

        :param reduce: what the search did to each state it reached; the path is in such states.
        :raises CoreMismatchError: the path is not in the model, or does not show what it should.
        """
        if path.states[0] != self._semantics.initial():
            raise _mismatch('it does not start in the initial state')
        walk = _Walk(self._semantics.initial(), self._semantics.initial(), path.end)
        stem = len(path.states) - 1 if path.cycle_start is None else path.cycle_start
        for target in path.states[1 : stem + 1]:
            self._advance(walk, target, reduce, set())
        if path.cycle_start is not None:
            self._go_round(walk, (*path.states[stem + 1 :], path.states[stem]), reduce)
        self._check_formulas(prop, walk.real)
        return self._run_of(walk.real)

    def _successors(self, state: State) -> list[Transition]:
        # The paths of one search share most of their beginnings.
        if state not in self._known:
            self._known[state] = list(self._semantics.successors(state))
        return self._known[state]

    def _fitting(self, state: State, target: State, reduce: Reduce | None) -> list[_Move]:
        """Return the moves that lead from one state of the search to what the next stands for."""
        key = state, target
        if key not in self._steps:
            moves = (
                (t.edges, reduce.forget(t.target, t.edges) if reduce else t.target)
                for t in self._successors(state)
            )
            self._steps[key] = [
                (edges, then)
                for edges, then in moves
                if (reduce.canonical(then) if reduce else then) == target
            ]
        if not self._steps[key]:
            raise _mismatch('one of its steps is no transition of the model')
        return self._steps[key]

    def _advance(
        self, walk: _Walk, target: State, reduce: Reduce | None, unserved: set[int]
    ) -> None:
        """Take the step that serves the most processes that are not served yet."""
        fitting = self._fitting(walk.searched, target, reduce)
        edges, then = max(fitting, key=lambda move: len({p for p, _ in move[0]} & unserved))
        self._extend(walk.real, edges)
        walk.searched = then

    def _go_round(self, walk: _Walk, targets: Sequence[State], reduce: Reduce | None) -> None:
        """
        Go round a cycle until a round ends where one began.

        After one round, values that are never read may differ from those at its start, and
        processes that are alike may have changed places.
        """
        begun: dict[tuple[State, State], int] = {}
        while (walk.searched, walk.real.states[-1]) not in begun:
            begun[walk.searched, walk.real.states[-1]] = len(walk.real.states) - 1
            is_fair = self._fairness is Fairness.WEAK
            unserved = set(range(len(self._network.processes))) if is_fair else set[int]()
            for target in targets:
                leaving = self._successors(walk.searched)
                unserved &= {process for t in leaving for process, _ in t.edges}
                before = len(walk.real.moves)
                self._advance(walk, target, reduce, unserved)
                unserved -= {p for move in walk.real.moves[before:] for p, _ in move.edges}
            if unserved:
                raise _mismatch('its cycle is not fair to every process')
        walk.real.cycle_start = begun[walk.searched, walk.real.states[-1]]

    def _extend(self, real: _RealPath, edges: Edges) -> None:
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
    def _run_of(self, real: _RealPath) -> Run:
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
