"""
Dead variables: values that nothing reads before they are written again, by process and location.

A process is unfolded into nodes: its location and the values of its *controls*, variables that
only it writes. At each node a backward analysis finds variables that neither this process nor a
predicate can read before they are overwritten. They are set to their initial value when the
process arrives there, which makes states equal that no query and no step distinguishes
(docs/checker.md, "Dead variables").
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field

from ros2cc_extract.checker.analyses.effects import (
    ConditionalRead,
    Effect,
    Effects,
    conditional_reads,
    slots_of,
    variables_of,
)
from ros2cc_extract.checker.network.network import (
    Assign,
    Const,
    Direction,
    Edge,
    Element,
    Expr,
    Network,
    Table,
    Var,
)
from ros2cc_extract.checker.network.partial_evaluation import Substitution
from ros2cc_extract.checker.network.semantics import Edges, State
from ros2cc_extract.checker.network.traversal import walk
from ros2cc_extract.light_dataclasses import dataclass

MAX_NODES = 2048
_MAX_CONTROL_VALUES = 64

#: Location and values of the controls.
Node = tuple[int, tuple[int, ...]]


@dataclass(frozen=True)
class Forgetting:
    """
    What one process makes forgettable.

    :param controls: slots of the variables that belong to a node.
    :param resets: variables, with their initial values, to reset at each node.
    """

    controls: tuple[int, ...]
    resets: Mapping[Node, tuple[tuple[int, int], ...]]


def forgettings(network: Network, predicates: Sequence[Expr]) -> tuple[Forgetting, ...]:
    """
    Return what each process makes forgettable, in process order.

    :param predicates: all formulae whose values must be kept.
    """
    usage = _Usage(network, predicates)
    return tuple(
        _ProcessAnalysis(number, usage).forgetting() for number in range(len(network.processes))
    )


def forget(forgotten: Sequence[Forgetting], state: State, edges: Edges) -> State:
    """Reset what the processes of ``edges`` make forgettable where they have arrived."""
    values = list(state.values)
    for process, _ in edges:
        own = forgotten[process]
        node = state.locations[process], tuple(values[slot] for slot in own.controls)
        for slot, value in own.resets.get(node, ()):
            values[slot] = value
    return State(state.locations, tuple(values))


class _Usage:
    """Which process reads and writes which variable."""

    def __init__(self, network: Network, predicates: Sequence[Expr]) -> None:
        self.network = network
        self.effects = Effects(network)
        self.predicate_reads: dict[int, list[ConditionalRead]] = {}
        for read in conditional_reads(predicates, self.effects):
            self.predicate_reads.setdefault(read.slot, []).append(read)
        count = len(network.variables)
        self.readers: list[set[int]] = [set() for _ in range(count)]
        self.writers: list[set[int]] = [set() for _ in range(count)]
        self.senders: list[list[tuple[int, Edge]]] = [[] for _ in network.channels]
        for number, process in enumerate(network.processes):
            for edge in process.edges:
                effect = self.effects.of_edge(edge)
                for slot in effect.reads:
                    self.readers[slot].add(number)
                for slot in effect.may_write:
                    self.writers[slot].add(number)
                if edge.sync is not None and edge.sync.direction is Direction.SEND:
                    for k in range(edge.sync.length):
                        self.senders[edge.sync.base + k].append((number, edge))

    def candidates(self, process: int) -> set[int]:
        """Return variables that can be dead because of what this process does."""
        found = set()
        for slot in range(len(self.network.variables)):
            readers, writers = self.readers[slot], self.writers[slot]
            if readers == {process}:
                found.add(slot)
            elif not readers and process in writers:
                is_asked_for = slot in self.predicate_reads
                if not is_asked_for or writers == {process}:
                    found.add(slot)
        return found

    def written_by_sender(self, edge: Edge, process: int) -> set[int]:
        """Return what every possible sender has written when a receiving edge updates."""
        sync = edge.sync
        if sync is None or sync.direction is Direction.SEND or sync.length != 1:
            return set()
        written: set[int] | None = None
        for owner, sender in self.senders[sync.base]:
            if owner != process:
                own = self._sent(sender, sync.base)
                written = own if written is None else written & own
        return written or set()

    def _sent(self, sender: Edge, channel: int) -> set[int]:
        """Return what a sender writes, given the channel it sends on."""
        assert sender.sync is not None
        index = sender.sync.index
        values = {index.slot: channel - sender.sync.base} if isinstance(index, Var) else {}
        written: set[int] = set()
        for update in sender.updates:
            known = Substitution(values).apply(update)
            effect = self.effects.of(known)
            written |= effect.writes
            for slot in effect.may_write:
                values.pop(slot, None)
        return written


@dataclass(eq=False)
class _Step:
    """An edge from a node: what it reads and surely writes, and where it may lead."""

    reads: set[int] = field(default_factory=set)
    writes: set[int] = field(default_factory=set)
    targets: list[Node] = field(default_factory=list)


class _ProcessAnalysis:
    def __init__(self, number: int, usage: _Usage) -> None:
        self._number = number
        self._usage = usage
        self._network = usage.network
        self._process = usage.network.processes[number]
        self._leaving = self._process.leaving()
        self._candidates = usage.candidates(number)
        self._controls = self._choose_controls()
        # By identity, with the expression, so that no other one can take its place.
        self._effects: dict[int, tuple[Expr, Effect]] = {}

    def forgetting(self) -> Forgetting:
        """Return the variables to reset at each node that has some."""
        if not self._candidates:
            return Forgetting((), {})
        steps = self._unfold()
        live = self._live(steps)
        resets = {node: self._resets(node, live) for node in steps}
        return Forgetting(self._controls, {node: found for node, found in resets.items() if found})

    # -- controls ------------------------------------------------------------------------
    def _choose_controls(self) -> tuple[int, ...]:
        variables = self._network.variables
        wanted = {
            slot
            for slot in self._interesting()
            if self._usage.writers[slot] == {self._number}
            and variables[slot].high - variables[slot].low < _MAX_CONTROL_VALUES
        }
        chosen: list[int] = []
        nodes = len(self._process.locations)
        for slot in sorted(wanted, key=lambda s: (variables[s].high - variables[s].low, s)):
            more = nodes * (variables[slot].high - variables[slot].low + 1)
            if more <= MAX_NODES:
                nodes = more
                chosen.append(slot)
        return tuple(sorted(chosen))

    def _interesting(self) -> set[int]:
        """Return variables that decide whether or where candidates are read."""
        found: set[int] = set()
        for slot in self._candidates:
            for read in self._usage.predicate_reads.get(slot, ()):
                for literal, _ in read.literals:
                    found |= variables_of(literal) - self._candidates
        for edge in self._process.edges:
            for expr in (edge.guard, *edge.updates):
                for node in walk(expr) if expr else ():
                    if isinstance(node, Table) or (
                        isinstance(node, Element) and self._candidates.intersection(slots_of(node))
                    ):
                        found |= variables_of(node.index)
        return found

    def _node_values(self, node: Node) -> dict[int, int]:
        return dict(zip(self._controls, node[1], strict=True))

    # -- unfolding -----------------------------------------------------------------------
    def _unfold(self) -> dict[Node, list[_Step]]:
        """Return the steps of every node that can be reached."""
        initial = tuple(self._network.variables[slot].initial for slot in self._controls)
        waiting: list[Node] = [(self._process.initial, initial)]
        steps: dict[Node, list[_Step]] = {}
        while waiting:
            node = waiting.pop()
            if node in steps:
                continue
            steps[node] = list(self._steps(node))
            waiting += [target for step in steps[node] for target in step.targets]
            # Forgetting a control leads to another node, which must be known as well.
            waiting += self._reset_nodes(node)
        return steps

    def _reset_nodes(self, node: Node) -> Iterator[Node]:
        for i, slot in enumerate(self._controls):
            if slot in self._candidates:
                initial = self._network.variables[slot].initial
                yield node[0], (*node[1][:i], initial, *node[1][i + 1 :])

    def _steps(self, node: Node) -> Iterator[_Step]:
        for _, edge in self._leaving[node[0]]:
            yield self._step(node, edge)

    def _step(self, node: Node, edge: Edge) -> _Step:
        values = self._node_values(node)
        known = Substitution(values)
        step = _Step()
        for expr in (edge.guard, edge.sync.index if edge.sync else None):
            if expr is not None:
                simple = known.apply(expr)
                step.reads |= self._reads(expr, simple)
                if expr is edge.guard and isinstance(simple, Const) and not simple.low:
                    # Leads nowhere as long as the controls keep it closed: so they are read.
                    return step
        step.writes |= self._usage.written_by_sender(edge, self._number)
        unknown: set[int] = set()
        for update in edge.updates:
            simple = Substitution(values).apply(update)
            step.reads |= self._reads(update, simple) - step.writes
            effect = self._effect(simple)
            step.writes |= effect.writes
            self._follow(simple, effect, values, unknown)
        step.targets = list(self._targets(edge.target, values, unknown))
        return step

    def _effect(self, expr: Expr) -> Effect:
        if id(expr) not in self._effects:
            self._effects[id(expr)] = expr, self._usage.effects.of(expr)
        return self._effects[id(expr)][1]

    def _reads(self, original: Expr, simple: Expr) -> set[int]:
        """Return the candidates read: controls count as read wherever they are mentioned."""
        controls = self._effect(original).reads.intersection(self._controls)
        return (self._effect(simple).reads | controls) & self._candidates

    def _follow(
        self, update: Expr, effect: Effect, values: dict[int, int], unknown: set[int]
    ) -> None:
        written = effect.may_write.intersection(self._controls)
        for slot in written:
            values.pop(slot, None)
            unknown.add(slot)
        if isinstance(update, Assign) and isinstance(update.target, Var):
            slot = update.target.slot
            if slot in written and isinstance(update.value, Const):
                values[slot] = update.value.low
                unknown.discard(slot)

    def _targets(
        self, location: int, values: Mapping[int, int], unknown: set[int]
    ) -> Iterable[Node]:
        variables = self._network.variables
        choices = [
            range(variables[slot].low, variables[slot].high + 1)
            if slot in unknown
            else (values[slot],)
            for slot in self._controls
        ]
        return ((location, chosen) for chosen in itertools.product(*choices))

    # -- liveness ------------------------------------------------------------------------
    def _live(self, steps: Mapping[Node, list[_Step]]) -> dict[Node, set[int]]:
        """Return what may be read from each node on, before it is written (a least fixpoint)."""
        # Sets as bits of integers: models of twenty callbacks have thousands of nodes.
        bit_of = {slot: 1 << i for i, slot in enumerate(sorted(self._candidates))}

        def bits(slots: Iterable[int]) -> int:
            return sum(bit_of[slot] for slot in slots if slot in bit_of)

        live = {node: bits(self._asked_for(node)) for node in steps}
        before: dict[Node, list[tuple[Node, int]]] = {node: [] for node in steps}
        for node, leaving in steps.items():
            for step in leaving:
                live[node] |= bits(step.reads)
                kept = ~bits(step.writes)
                for target in step.targets:
                    before[target].append((node, kept))
        waiting = list(steps)
        while waiting:
            target = waiting.pop()
            for node, kept in before[target]:
                grown = live[node] | live[target] & kept
                if grown != live[node]:
                    live[node] = grown
                    waiting.append(node)
        return {
            node: {slot for slot, bit in bit_of.items() if found & bit}
            for node, found in live.items()
        }

    def _asked_for(self, node: Node) -> set[int]:
        """Return the candidates that a predicate may read at a node."""
        known = Substitution(self._node_values(node), (self._number, node[0]))
        return {
            slot
            for slot in self._candidates
            for read in self._usage.predicate_reads.get(slot, ())
            if all(_may_be(known.apply(literal), value) for literal, value in read.literals)
        }

    def _resets(self, node: Node, live: Mapping[Node, set[int]]) -> tuple[tuple[int, int], ...]:
        """Return the resets at a node: plain variables first, then controls one by one."""
        variables = self._network.variables
        dead = self._candidates - live[node]
        resets = [slot for slot in sorted(dead) if slot not in self._controls]
        at = node
        for i, slot in enumerate(self._controls):
            if slot in self._candidates and slot not in live[at]:
                resets.append(slot)
                at = at[0], (*at[1][:i], variables[slot].initial, *at[1][i + 1 :])
                further = self._candidates - live[at] - set(self._controls) - set(resets)
                resets += sorted(further)
        return tuple((slot, variables[slot].initial) for slot in resets)


def _may_be(expr: Expr, value: bool) -> bool:
    return not isinstance(expr, Const) or bool(expr.low) is value
