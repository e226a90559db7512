"""
Successors as generated Python functions, planned once per vector of locations.

Which edges can move together depends on the locations alone, but for guards and channel
indices; so the choice is made once for each vector of locations that occurs, and a state only
runs the functions of its plan. Order of the moves: that of ``semantics.py``.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from ros2cc_extract.checker.engines.generated_python import INDENT, SourceWriter
from ros2cc_extract.checker.engines.state_layout import Layout
from ros2cc_extract.checker.network.arithmetic import OPERATIONS
from ros2cc_extract.checker.network.interpreter import endless_error, site_error
from ros2cc_extract.checker.network.network import Check, Direction, Edge, Expr, Network, Op, Sync
from ros2cc_extract.checker.network.semantics import EdgeRef
from ros2cc_extract.checker.network.traversal import walk
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.light_dataclasses import dataclass

Edges = tuple[EdgeRef, ...]
_TOO_DEEP = ModelFormatError(
    'an expression nests too deep for the pure Python checker',
    None,
    'use the native core, or split the expression',
)

#: From a packed state to the next one, or -1 when the move is not enabled.
Move = Callable[[int], int]
#: From a packed state to all next ones, with the label of each.
Moves = Callable[[int], list[tuple[int, int]]]


@dataclass(frozen=True)
class Plan:
    """
    What can happen in one vector of locations.

    :param steps: in order; a ``Move`` with its label, or ``Moves`` with label -1.
    :param may_idle: nothing urgent or committed is active.
    :param urgent: the steps that synchronise on an urgent channel.
    """

    steps: tuple[tuple[Any, int], ...]
    may_idle: bool
    urgent: tuple[tuple[Any, int], ...]

    def is_idle(self, packed: int) -> bool:
        """Whether time may diverge in a state of this plan."""
        if not self.may_idle:
            return False
        return not any(
            move(packed) if label < 0 else move(packed) >= 0 for move, label in self.urgent
        )


class Moving:
    """Plans for one network; ``labels`` numbers the sets of edges that moved together."""

    def __init__(self, network: Network, layout: Layout) -> None:
        self._network = network
        self._layout = layout
        self._writer = SourceWriter(network, layout)
        self._names: dict[str, Any] = {
            '_fail': self._fail,
            '_endless': self._endless,
            '_passes': [0],
            '_quotient': OPERATIONS[Op.DIV],
            '_remainder': OPERATIONS[Op.MOD],
        }
        self.labels: list[Edges] = []
        self._label_of: dict[Edges, int] = {}
        self._compiled: dict[object, Any] = {}
        self._outgoing = [process.leaving() for process in network.processes]
        lines = [line for i in range(len(network.functions)) for line in self._writer.function(i)]
        self._run('\n'.join(lines))

    # -- plans ---------------------------------------------------------------------------
    def plan(self, packed: int) -> Plan:
        """Return the plan of the locations of a state."""
        at = [packed >> field.shift & field.ones for field in self._layout.locations]
        places = [
            process.locations[here]
            for process, here in zip(self._network.processes, at, strict=True)
        ]
        committed = {i for i, location in enumerate(places) if location.is_committed}
        steps: list[tuple[Any, int]] = []
        urgent: list[tuple[Any, int]] = []
        for process, here in enumerate(at):
            for number, edge in self._outgoing[process][here]:
                found = self._steps((process, number), edge, at, committed)
                steps += found
                if edge.sync and self._network.channels[edge.sync.base].is_urgent:
                    urgent += found
        may_idle = not any(location.is_urgent or location.is_committed for location in places)
        return Plan(tuple(steps), may_idle, tuple(urgent))

    def _steps(
        self, own: EdgeRef, edge: Edge, at: Sequence[int], committed: set[int]
    ) -> list[tuple[Any, int]]:
        if edge.sync is None:
            return [self._move((own,))] if not committed or own[0] in committed else []
        if edge.sync.direction is Direction.RECEIVE:
            return []
        receivers = list(self._receivers(own[0], edge.sync, at))
        steps = [self._probe(own)] if _may_fail(edge.sync.index) else []
        if self._network.channels[edge.sync.base].is_broadcast:
            return steps + self._broadcast(own, receivers, committed)
        return steps + [
            self._move((own, receiver))
            for receiver in receivers
            if not committed or own[0] in committed or receiver[0] in committed
        ]

    def _receivers(self, sender: int, sync: Sync, at: Sequence[int]) -> Iterator[EdgeRef]:
        for process, here in enumerate(at):
            if process == sender:
                continue
            for number, edge in self._outgoing[process][here]:
                other = edge.sync
                if other is None or other.direction is Direction.SEND:
                    continue
                if sync.base < other.base + other.length and other.base < sync.base + sync.length:
                    yield process, number

    def label(self, edges: Edges) -> int:
        """Return the number of a set of edges."""
        if edges not in self._label_of:
            self._label_of[edges] = len(self.labels)
            self.labels.append(edges)
        return self._label_of[edges]

    # -- generated functions -------------------------------------------------------------
    def _edge(self, reference: EdgeRef) -> Edge:
        return self._network.processes[reference[0]].edges[reference[1]]

    def _move(self, edges: Edges) -> tuple[Move, int]:
        if edges not in self._compiled:
            lines = ['def move(s):', *self._guards(edges), *self._effects(edges)]
            self._compiled[edges] = self._define('move', lines)
        return self._compiled[edges], self.label(edges)

    def _probe(self, sender: EdgeRef) -> tuple[Move, int]:
        """Return a move that never happens but fails where the channel index does."""
        key = 'probe', sender
        if key not in self._compiled:
            sync = self._edge(sender).sync
            assert sync is not None
            index = f'{INDENT}{self._channel(sync)}'
            lines = ['def probe(s):', *self._enabled(sender), index, f'{INDENT}return -1']
            self._compiled[key] = self._define('probe', lines)
        return self._compiled[key], self.label((sender,))

    def _guards(self, edges: Edges) -> list[str]:
        """Return statements that leave the move unless guards and channels allow it."""
        lines = self._enabled(edges[0])
        for receiver in edges[1:]:
            lines += self._enabled(receiver) + self._matching(edges[0], receiver)
        return lines

    def _enabled(self, reference: EdgeRef) -> list[str]:
        guard = self._edge(reference).guard
        if guard is None:
            return []
        return [f'{INDENT}if not {self._writer.value(guard)}: return -1']

    def _matching(self, sender: EdgeRef, receiver: EdgeRef) -> list[str]:
        syncs = [self._edge(reference).sync for reference in (sender, receiver)]
        if all(sync is None or sync.length == 1 for sync in syncs):
            return []
        there, here = (self._channel(sync) for sync in syncs if sync)
        return [f'{INDENT}if {there} != {here}: return -1']

    def _channel(self, sync: Sync) -> str:
        return f'{sync.base} + {self._writer.value(sync.index)}'

    def _effects(self, edges: Edges) -> list[str]:
        flips = 0
        lines: list[str] = []
        for reference in edges:
            edge, shift = self._edge(reference), self._layout.locations[reference[0]].shift
            flips ^= (edge.source ^ edge.target) << shift
            lines += self._writer.updates(edge.updates, INDENT)
        return [*lines, f'{INDENT}return s ^ {flips:#x}']

    def predicate(self, exprs: Sequence[Expr]) -> Callable[[int, bool], int]:
        """Return a function from state and deadlock to a bit for each expression."""
        bits = [
            f'({1 << i:#x} if {self._writer.value(expr)} else 0)' for i, expr in enumerate(exprs)
        ]
        lines = ['def predicate(s, dead):', f'{INDENT}return {" | ".join(bits) or 0}']
        return self._define('predicate', lines)  # type: ignore[no-any-return]

    def _define(self, name: str, lines: Sequence[str]) -> Any:
        self._run('\n'.join(lines))
        return self._names[name]

    def _run(self, source: str) -> None:
        self._names.update((name, values) for values, name in self._writer.tables.items())
        try:
            exec(compile(source, '<network>', 'exec'), self._names)
        except (SyntaxError, RecursionError, MemoryError):
            # Python's own parser has limits that nested functions can reach.
            raise _TOO_DEEP from None

    def _fail(self, site: int, value: int) -> int:
        raise site_error(self._network.sites[site], value)

    def _endless(self, function: int) -> None:
        raise endless_error(self._network.functions[function])

    # -- broadcasts ----------------------------------------------------------------------
    def _broadcast(
        self, own: EdgeRef, receivers: list[EdgeRef], committed: set[int]
    ) -> list[tuple[Any, int]]:
        own_committed = not committed or own[0] in committed
        if not receivers:
            return [self._move((own,))] if own_committed else []
        guards = [
            (process, [(receiver, self._test(own, receiver)) for receiver in of_process])
            for process, of_process in itertools.groupby(receivers, lambda ref: ref[0])
        ]
        sender = self._test(own, None)

        def moves(packed: int) -> list[tuple[int, int]]:
            if not sender(packed):
                return []
            ready = [[receiver for receiver, test in tests if test(packed)] for _, tests in guards]
            found = []
            for chosen in itertools.product(*(edges for edges in ready if edges)):
                if own_committed or any(edge[0] in committed for edge in chosen):
                    edges = (own, *chosen)
                    found.append((self._apply(edges)(packed), self.label(edges)))
            return found

        return [(moves, -1)]

    def _test(self, sender: EdgeRef, receiver: EdgeRef | None) -> Callable[[int], bool]:
        key = 'test', sender, receiver
        if key not in self._compiled:
            if receiver is None:
                lines = ['def test(s):', *self._enabled(sender)]
            else:
                enabled = self._enabled(receiver)
                lines = ['def test(s):', *enabled, *self._matching(sender, receiver)]
            lines.append(f'{INDENT}return 1')
            self._compiled[key] = self._define('test', lines)
        test = self._compiled[key]
        return lambda packed: test(packed) >= 0

    def _apply(self, edges: Edges) -> Move:
        key = 'apply', edges
        if key not in self._compiled:
            lines = ['def apply(s):', *self._effects(edges)]
            self._compiled[key] = self._define('apply', lines)
        return self._compiled[key]  # type: ignore[no-any-return]


def _may_fail(index: Expr) -> bool:
    return any(isinstance(node, Check) for node in walk(index))
