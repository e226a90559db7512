"""
The plain semantics: initial state and successors, by interpretation.

Every engine explores this relation, in this order; every path is replayed by it. Source of the
rules on committed locations, broadcast channels and the order of updates: UPPAAL documentation,
pages "Semantics" and "Edges".
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from ros2cc_extract.checker.network.interpreter import Interpreter, Memory
from ros2cc_extract.checker.network.network import Direction, Edge, Expr, Network
from ros2cc_extract.light_dataclasses import dataclass

#: Process number and edge number within the process.
EdgeRef = tuple[int, int]


#: The edges that move together, the sender first.
Edges = tuple[EdgeRef, ...]


@dataclass(frozen=True)
class State:
    """One location per process, then one value per variable."""

    locations: tuple[int, ...]
    values: tuple[int, ...]


@dataclass(frozen=True)
class Transition:
    """Edges that move together, and the state they lead to."""

    edges: Edges
    target: State


class Semantics:
    """Successors of states of one network."""

    def __init__(self, network: Network) -> None:
        self._network = network
        self._interpreter = Interpreter(network)
        self._leaving = [process.leaving() for process in network.processes]

    def initial(self) -> State:
        """Return the initial state."""
        processes, variables = self._network.processes, self._network.variables
        return State(
            tuple(process.initial for process in processes),
            tuple(variable.initial for variable in variables),
        )

    def evaluate(self, expr: Expr, state: State, is_deadlock: bool) -> int:
        """Evaluate a state expression; the caller knows what ``deadlock`` is here."""
        memory = self._memory(state)
        memory.is_deadlock = is_deadlock
        return self._interpreter.value(expr, memory)

    def successors(self, state: State) -> Iterator[Transition]:
        """
        Yield the transitions of a state: by the sender's process, its edges, then receivers.

        :raises ModelFormatError: a guard, index or update breaks a range.
        """
        must_leave = self._committed(state)
        for process, at in enumerate(state.locations):
            for number, edge in self._leaving[process][at]:
                if edge.sync is None or edge.sync.direction is Direction.SEND:
                    for edges in self._moves(state, process, number, edge):
                        if not must_leave or any(p in must_leave for p, _ in edges):
                            yield Transition(edges, self._target(state, edges))

    def may_idle(self, state: State) -> bool:
        """Whether time may diverge: nothing urgent or committed, no urgent channel enabled."""
        processes = self._network.processes
        for process, at in zip(processes, state.locations, strict=True):
            if process.locations[at].is_urgent or process.locations[at].is_committed:
                return False
        moves = self.successors(state)
        return not any(self._is_urgent(move.edges[0]) for move in moves)

    def _is_urgent(self, sender: EdgeRef) -> bool:
        sync = self.edge(sender).sync
        return sync is not None and self._network.channels[sync.base].is_urgent

    def edge(self, reference: EdgeRef) -> Edge:
        """Return the edge of a reference."""
        process, number = reference
        return self._network.processes[process].edges[number]

    def _memory(self, state: State) -> Memory:
        return Memory(list(state.locations), list(state.values))

    def _committed(self, state: State) -> set[int]:
        return {
            number
            for number, at in enumerate(state.locations)
            if self._network.processes[number].locations[at].is_committed
        }

    def _holds(self, edge: Edge, state: State) -> bool:
        return edge.guard is None or bool(self._interpreter.value(edge.guard, self._memory(state)))

    def channel(self, edge: Edge, state: State) -> int:
        """Return the channel number of an edge that synchronises."""
        assert edge.sync is not None
        return edge.sync.base + self._interpreter.value(edge.sync.index, self._memory(state))

    def _moves(
        self, state: State, process: int, number: int, edge: Edge
    ) -> Iterator[tuple[EdgeRef, ...]]:
        if not self._holds(edge, state):
            return
        own = (process, number)
        if edge.sync is None:
            yield (own,)
            return
        channel = self.channel(edge, state)
        ready = [
            self._receivers(other, channel, state)
            for other in range(len(state.locations))
            if other != process
        ]
        if self._network.channels[channel].is_broadcast:
            for chosen in itertools.product(*(edges for edges in ready if edges)):
                yield (own, *chosen)
        else:
            for edges in ready:
                for receiver in edges:
                    yield own, receiver

    def _receivers(self, process: int, channel: int, state: State) -> list[EdgeRef]:
        found = []
        for number, edge in self._leaving[process][state.locations[process]]:
            sync = edge.sync
            if sync is None or sync.direction is Direction.SEND:
                continue
            may_match = sync.base <= channel < sync.base + sync.length
            if may_match and self._holds(edge, state) and self.channel(edge, state) == channel:
                found.append((process, number))
        return found

    def _target(self, state: State, edges: tuple[EdgeRef, ...]) -> State:
        memory = self._memory(state)
        for reference in edges:
            edge = self.edge(reference)
            memory.locations[reference[0]] = edge.target
            for update in edge.updates:
                self._interpreter.value(update, memory)
        return State(tuple(memory.locations), tuple(memory.values))
