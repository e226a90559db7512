"""
Symmetry: processes of one template that differ in nothing but their name.

States that differ only in which of them does what are one state; ``canonical_states.py`` chooses
it. What makes a family is shown for each member and the first one by exchanging the two in the
whole network and in all predicates (``equivariance.py``); all other permutations are made of such
exchanges (docs/checker.md, "Symmetry").
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ros2cc_extract.checker.analyses.effects import Effects
from ros2cc_extract.checker.analyses.equivariance import Equivariance, Exchange, Pick
from ros2cc_extract.checker.network.network import (
    Assign,
    Binary,
    Call,
    Check,
    Const,
    Direction,
    Edge,
    Element,
    Expr,
    Network,
    Op,
    Process,
    Var,
)
from ros2cc_extract.checker.network.traversal import function_expressions, walk
from ros2cc_extract.light_dataclasses import dataclass

#: What it costs to compare an edge with what an exchange makes of it, in nodes.
_NODES_OF_EDGE = 10
#: Nodes of predicates and edges, times exchanges: from here on a proof takes longer than a search.
_MAX_WORK = 2_000_000
_ELEMENT = re.compile(r'(?P<array>[^\[]+)\[(?P<index>\d+)\]')


@dataclass(frozen=True)
class Family:
    """
    Processes that can be exchanged.

    :param names: how arrays and pointers call each; empty if none calls them.
    :param parts: the variables that are each one's own, in the same order for all.
    :param pointers: variables outside the parts that hold the name of one.
    :param picks: functions that choose the lowest name among some, by number.
    """

    processes: tuple[int, ...]
    names: tuple[int, ...]
    parts: tuple[tuple[int, ...], ...]
    pointers: tuple[int, ...]
    picks: Mapping[int, Pick]


def families(network: Network, predicates: Sequence[Expr]) -> tuple[Family, ...]:
    """
    Return the families of a network, disjoint in all that is theirs.

    :param predicates: all formulae whose values must be kept.
    """
    by_template: dict[str, list[int]] = {}
    for number, process in enumerate(network.processes):
        by_template.setdefault(process.template, []).append(number)
    found: list[Family] = []
    taken: set[int] = set()
    finder = _Finder(network, predicates)
    size = sum(len(walk(predicate)) for predicate in predicates)
    size += _NODES_OF_EDGE * sum(len(process.edges) for process in network.processes)
    for members in by_template.values():
        if size * (len(members) - 1) > _MAX_WORK:
            continue
        for family in _families_among(finder, members):
            own = {slot for part in family.parts for slot in part}.union(family.pointers)
            if not own & taken:
                taken |= own
                found.append(family)
    return tuple(found)


def _families_among(finder: _Finder, members: list[int]) -> Iterator[Family]:
    left = list(members)
    while len(left) > 1:
        first, *rest = left
        exchanges: list[_Proven] = []
        for other in rest:
            proven = finder.exchange(first, other)
            if proven is not None and (not exchanges or proven.fits(exchanges[0])):
                exchanges.append(proven)
        if exchanges:
            yield _family(first, exchanges)
        grouped = {first, *(proven.exchange.processes[1] for proven in exchanges)}
        left = [number for number in left if number not in grouped]


@dataclass(frozen=True)
class _Proven:
    exchange: Exchange
    own: tuple[int, ...]
    picks: Mapping[int, Pick]

    def fits(self, other: _Proven) -> bool:
        """Whether both exchanges move the same variables of the first process."""
        mine, others = self.exchange, other.exchange
        return (self.own, self.picks) == (other.own, other.picks) and (
            mine.pointers == others.pointers
        )


def _family(first: int, exchanges: Sequence[_Proven]) -> Family:
    own = exchanges[0].own
    members = [(first, own)]
    names = [exchanges[0].exchange.names]
    for proven in exchanges:
        slots = proven.exchange.slots
        members.append((proven.exchange.processes[1], tuple(slots[slot] for slot in own)))
        names.append(proven.exchange.names)
    called = [pair for pair in names if pair is not None]
    return Family(
        processes=tuple(process for process, _ in members),
        names=(called[0][0], *(pair[1] for pair in called[1:])) if called else (),
        parts=tuple(part for _, part in members),
        pointers=tuple(sorted(exchanges[0].exchange.pointers)),
        picks=exchanges[0].picks,
    )


class _Finder:
    """Proposes exchanges and proves them; knows which process mentions what."""

    def __init__(self, network: Network, predicates: Sequence[Expr]) -> None:
        self._network = network
        self._predicates = predicates
        self._effects = Effects(network)
        names = [variable.name for variable in network.variables]
        self._slots = {name: slot for slot, name in enumerate(names)}
        self._arrays = _arrays(names)
        self._channel_arrays = _arrays([channel.name for channel in network.channels])
        self._bases = {array[0]: array for array in self._arrays}
        self._meetings = _meetings(network, predicates)
        self._mentions: dict[int, _Mentions] = {}

    def exchange(self, first: int, second: int) -> _Proven | None:
        """Return the exchange of two processes if it changes nothing."""
        one, other = self._network.processes[first], self._network.processes[second]
        names = _names(one, other)
        if names == () or (one.initial, len(one.edges)) != (other.initial, len(other.edges)):
            return None
        # Arrays that only others use, element by element, may be about the two as well.
        for with_alike in (False, True):
            exchange = Exchange((first, second), names or None, {}, {})
            own = self._move_own(exchange, with_alike)
            picks = None if own is None else self._proven_picks(exchange)
            if own is not None and picks is not None:
                return _Proven(exchange, own, picks)
        return None

    def _proven_picks(self, exchange: Exchange) -> Mapping[int, Pick] | None:
        """Return the picks among those that can be exchanged; None if these two cannot."""
        if not self._is_fit(exchange) or not self._receives_apart(exchange):
            return None
        by = Equivariance(self._network, exchange)
        for number, process in enumerate(self._network.processes):
            target = self._network.processes[exchange.process(number)]
            if not by.same_edges(process.edges, target.edges):
                return None
        is_same = all(by.same(predicate, predicate) for predicate in self._predicates)
        return by.picks if is_same else None

    # -- what is moved -------------------------------------------------------------------
    def _move_own(self, exchange: Exchange, with_alike: bool) -> tuple[int, ...] | None:
        """Move what the two declare, and the elements that bear their names."""
        first, second = exchange.processes
        one, other = (self._network.processes[number].name + '.' for number in (first, second))
        own = []
        for name, slot in self._slots.items():
            if name.startswith(one):
                partner = self._slots.get(other + name.removeprefix(one))
                if partner is None:
                    return None
                own.append(slot)
                _swap(exchange.slots, slot, partner)
        if exchange.names is not None:
            own += self._move_elements(exchange, with_alike)
        return tuple(own)

    def _move_elements(self, exchange: Exchange, with_alike: bool) -> list[int]:
        assert exchange.names is not None
        i, j = exchange.names
        one, other = (self._mentioned(number) for number in exchange.processes)
        for array in self._channel_arrays:
            if max(i, j) < len(array) and one.channels[array[i]] != other.channels[array[i]]:
                _swap(exchange.channels, array[i], array[j])
        own: list[int] = []
        moved: set[int] = set()
        lengths = {
            len(a)
            for a in self._channel_arrays
            if max(i, j) < len(a) and a[i] in exchange.channels
        }
        exchange.pointers.update(self._compared_with_names(exchange))
        while True:
            self._close_pointers(exchange)
            wanted = [
                array
                for array in self._arrays
                if array[0] not in moved
                and max(i, j) < len(array)
                and (
                    one.slots[array[i]] != other.slots[array[i]]
                    or self._meetings.indices.get(array[0], set()) & exchange.pointers
                    or (with_alike and len(array) in lengths)
                )
            ]
            if not wanted:
                return own
            for array in wanted:
                lengths.add(len(array))
                moved.add(array[0])
                own.append(array[i])
                _swap(exchange.slots, array[i], array[j])

    def _compared_with_names(self, exchange: Exchange) -> Iterator[int]:
        """Yield what is no element of their own and each compares with, or sets to, its name."""
        assert exchange.names is not None
        i, j = exchange.names
        one, other = (self._mentioned(number) for number in exchange.processes)
        for slot, value in one.constants:
            is_alike = slot not in exchange.slots and one.slots[slot] == other.slots[slot]
            beside = one.constants[slot, i]
            differs = beside != other.constants[slot, i]
            if value == i and is_alike and differs and beside == other.constants[slot, j]:
                yield slot

    def _close_pointers(self, exchange: Exchange) -> None:
        """Add the variables that are an index where names are, or meet pointers."""
        pointers, count = exchange.pointers, -1
        while count != len(pointers):
            count = len(pointers)
            for base, slots in self._meetings.indices.items():
                if base in self._bases and self._is_moved(base, exchange):
                    pointers |= slots
            for pair in self._meetings.pairs:
                if pair & pointers:
                    pointers |= pair
            for base, slots in self._meetings.channels.items():
                if base in exchange.channels:
                    pointers |= slots

    def _is_moved(self, base: int, exchange: Exchange) -> bool:
        return any(slot in exchange.slots for slot in self._bases[base])

    def _is_fit(self, exchange: Exchange) -> bool:
        """Whether values and names stay in range, and no part holds a name."""
        variables = self._network.variables
        if exchange.pointers.intersection(exchange.slots):
            return False
        names = exchange.names or ()
        for slot in exchange.pointers:
            if not all(variables[slot].low <= name <= variables[slot].high for name in names):
                return False
        return all(
            (variables[a].low, variables[a].high) == (variables[b].low, variables[b].high)
            for a, b in exchange.slots.items()
        )

    def _receives_apart(self, exchange: Exchange) -> bool:
        """Whether the order of the receivers of broadcasts does not matter to the two."""
        first, second = exchange.processes
        theirs = set(exchange.slots)
        for receivers in self._broadcast_receivers().values():
            if not any(number in exchange.processes for number, _ in receivers):
                continue
            written = {
                slot for _, edge in receivers for slot in self._effects.of_edge(edge).may_write
            }
            for number, edge in receivers:
                effect = self._effects.of_edge(edge)
                touched = effect.reads | effect.may_write
                if number not in exchange.processes:
                    if touched & theirs:
                        return False
                    continue
                own = {s for s in theirs if self._is_of(s, number, exchange)}
                if not effect.may_write <= own or (effect.reads - own) & (written | theirs):
                    return False
        return first != second

    def _is_of(self, slot: int, process: int, exchange: Exchange) -> bool:
        variable = self._network.variables[slot].name
        if variable.startswith(self._network.processes[process].name + '.'):
            return True
        found = _ELEMENT.fullmatch(variable)
        if exchange.names is None or found is None:
            return False
        name = exchange.names[exchange.processes.index(process)]
        return int(found['index']) == name

    def _broadcast_receivers(self) -> dict[int, list[tuple[int, Edge]]]:
        found: dict[int, list[tuple[int, Edge]]] = {}
        for number, process in enumerate(self._network.processes):
            for edge in process.edges:
                sync = edge.sync
                if sync is None or sync.direction is Direction.SEND:
                    continue
                for channel in range(sync.base, sync.base + sync.length):
                    if self._network.channels[channel].is_broadcast:
                        found.setdefault(channel, []).append((number, edge))
        return found

    # -- mentioned names ---------------------------------------------------------------
    def _mentioned(self, process: int) -> _Mentions:
        if process not in self._mentions:
            self._mentions[process] = _mentions(self._network, process)
        return self._mentions[process]


@dataclass(frozen=True)
class _Meetings:
    """
    Which variables meet: by being set to, or compared with, one another, or used as an index.

    :param indices: by the first element of the array; ``channels`` likewise.
    """

    pairs: set[frozenset[int]]
    indices: dict[int, set[int]]
    channels: dict[int, set[int]]


def _meetings(network: Network, predicates: Sequence[Expr]) -> _Meetings:
    found = _Meetings(set(), {}, {})
    tops = list(predicates)
    for process in network.processes:
        for edge in process.edges:
            tops += _expressions(edge)
            if edge.sync is not None and edge.sync.length > 1:
                found.channels.setdefault(edge.sync.base, set()).update(_variable(edge.sync.index))
    for function in network.functions:
        tops += function_expressions(function.body)
    for top in tops:
        for node in walk(top):
            if isinstance(node, Element):
                found.indices.setdefault(node.base, set()).update(_variable(node.index))
            elif isinstance(node, Assign):
                _note_pair(found, node.target, node.value)
            elif isinstance(node, Binary) and node.op in (Op.EQ, Op.NE):
                _note_pair(found, node.left, node.right)
    return found


def _note_pair(found: _Meetings, one: Expr, other: Expr) -> None:
    pair = frozenset(_variable(one) | _variable(other))
    if len(pair) == 2:
        found.pairs.add(pair)


@dataclass(frozen=True)
class _Mentions:
    """How often a process mentions variables, channels, and constants beside variables."""

    slots: Counter[int]
    channels: Counter[int]
    constants: Counter[tuple[int, int]]


def _mentions(network: Network, number: int) -> _Mentions:
    found = _Mentions(Counter(), Counter(), Counter())
    entered: set[int] = set()
    waiting: list[Expr] = []
    for edge in network.processes[number].edges:
        waiting += _expressions(edge)
        if edge.sync is not None and edge.sync.length == 1:
            found.channels[edge.sync.base] += 1
    while waiting:
        for node in walk(waiting.pop()):
            if isinstance(node, Var):
                found.slots[node.slot] += 1
            elif isinstance(node, Call) and node.function not in entered:
                entered.add(node.function)
                waiting += function_expressions(network.functions[node.function].body)
            elif isinstance(node, Assign):
                _count_constant(found, node.target, node.value)
            elif isinstance(node, Binary) and node.op in (Op.EQ, Op.NE):
                _count_constant(found, node.left, node.right)
                _count_constant(found, node.right, node.left)
    return found


def _count_constant(found: _Mentions, variable: Expr, value: Expr) -> None:
    if isinstance(variable, Var) and isinstance(value, Const):
        found.constants[variable.slot, value.low] += 1


def _expressions(edge: Edge) -> Iterator[Expr]:
    for expr in (edge.guard, edge.sync.index if edge.sync else None, *edge.updates):
        if expr is not None:
            yield expr


def _names(one: Process, other: Process) -> tuple[int, int] | tuple[()] | None:
    """Return the one argument in which two differ; None if they do not, () if they do more."""
    pairs = [pair for pair in zip(one.arguments, other.arguments, strict=True) if len({*pair}) > 1]
    if not pairs:
        return None
    return pairs[0] if len(pairs) == 1 and min(pairs[0]) >= 0 else ()


def _arrays(names: Iterable[str]) -> list[range]:
    """Return the numbers of the elements of each array of one dimension."""
    found: dict[str, list[int]] = {}
    for number, name in enumerate(names):
        parts = _ELEMENT.fullmatch(name)
        if parts:
            found.setdefault(parts['array'], []).append(number)
    return [range(numbers[0], numbers[-1] + 1) for numbers in found.values()]


def _swap(places: dict[int, int], one: int, other: int) -> None:
    places[one], places[other] = other, one


def _variable(expr: Expr) -> set[int]:
    slot = _stripped(expr)
    return set() if slot is None else {slot}


def _stripped(expr: Expr) -> int | None:
    """Return the variable that an expression is, if it is one."""
    while isinstance(expr, Check):
        expr = expr.operand
    return expr.slot if isinstance(expr, Var) else None
