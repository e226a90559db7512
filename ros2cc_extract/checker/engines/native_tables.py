"""
Lowers a network to the integer tables of the native core.

The meaning of a node's three operands stands in ``native/machine.hpp``; the numbers of the
operations come from the core itself.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import field
from typing import TYPE_CHECKING, Any

from ros2cc_extract.checker.analyses.dead_variables import Forgetting
from ros2cc_extract.checker.analyses.reads import reads_of
from ros2cc_extract.checker.network.network import (
    Assign,
    AtLocation,
    Binary,
    Call,
    Check,
    Choice,
    Const,
    DeadlockAtom,
    Direction,
    Edge,
    Element,
    Evaluate,
    Expr,
    ForRange,
    If,
    Local,
    LocalElement,
    Network,
    Op,
    Process,
    Return,
    Stmt,
    Table,
    Unary,
    Var,
)
from ros2cc_extract.light_dataclasses import dataclass

if TYPE_CHECKING:
    from ros2cc_extract.checker.analyses.symmetry import Family as Members

#: Node, whether it reads ``deadlock``, and which variables and processes it reads.
Predicate = tuple[int, bool, list[int], list[int]]
#: Slot, initial value, and the processes that may forget it.
Pointer = tuple[int, int, list[int]]
#: Processes, their names, their variables, and the pointers to them.
Family = tuple[list[int], list[int], list[list[int]], list[Pointer]]
NONE = -1
_SYNC = {Direction.SEND: 1, Direction.RECEIVE: 2}


@dataclass(eq=False)
class Tables:
    """What ``_core.search`` takes, by the names of its arguments."""

    nodes: list[int] = field(default_factory=list)
    lists: list[int] = field(default_factory=list)
    ranges: list[int] = field(default_factory=list)
    functions: list[int] = field(default_factory=list)
    edges: list[int] = field(default_factory=list)
    channels: list[int] = field(default_factory=list)
    variables: list[int] = field(default_factory=list)
    initial: list[int] = field(default_factory=list)
    locations: list[list[int]] = field(default_factory=list)
    forgettings: list[tuple[list[int], int, list[int]]] = field(default_factory=list)
    families: list[Family] = field(default_factory=list)
    picks: list[int] = field(default_factory=list)


class Lowering:
    """
    Lowers one network.

    :param operations: names of the core's operations, by number.
    """

    def __init__(self, network: Network, operations: Sequence[str]) -> None:
        self._network = network
        self._numbers = {name: number for number, name in enumerate(operations)}
        self.tables = Tables()
        # By identity: hashing would walk through each expression again at every level.
        self._known: dict[int, tuple[Expr, int]] = {}
        self._handlers: dict[type, Callable[[Any], int]] = {
            Const: lambda node: self._node('CONST', node.low),
            Var: lambda node: self._node('VAR', node.slot),
            Element: lambda node: self._node('ELEMENT', node.base, self.expr(node.index)),
            Table: lambda node: self._node(
                'TABLE', self._list(node.values), self.expr(node.index)
            ),
            Local: lambda node: self._node('LOCAL', node.slot),
            LocalElement: lambda node: self._node(
                'LOCAL_ELEMENT', node.base, self.expr(node.index)
            ),
            Unary: lambda node: self._node(node.op.name, self.expr(node.operand)),
            Binary: self._binary,
            Choice: lambda node: self._node(
                'CHOICE',
                self.expr(node.condition),
                self.expr(node.then),
                self.expr(node.otherwise),
            ),
            Check: self._check,
            Call: self._call,
            Assign: self._assign,
            AtLocation: lambda node: self._node('AT', node.process, node.location),
            DeadlockAtom: lambda node: self._node('DEADLOCK'),
        }
        self._lower_network()

    def predicate(self, expr: Expr) -> Predicate:
        """Lower a state predicate."""
        reads = reads_of(expr, self._network)
        return (
            self.expr(expr),
            reads.deadlock,
            sorted(reads.variables),
            sorted(reads.processes),
        )

    def forget(self, forgettings: Sequence[Forgetting]) -> None:
        """Add what processes make forgettable."""
        for process, forgetting in zip(self._network.processes, forgettings, strict=True):
            self.tables.forgettings.append(self._forgetting(process, forgetting))

    def order(self, families: Sequence[Members], forgettings: Sequence[Forgetting]) -> None:
        """Add the families whose members can be exchanged; nodes and lists may grow."""
        functions = len(self._network.functions)
        self.tables.picks = [NONE, 0, 0, 0, NONE, 0] * functions if families else []
        self.tables.families = [
            (
                [*family.processes],
                [*family.names],
                [[*part] for part in family.parts],
                [self._pointer(slot, forgettings) for slot in family.pointers],
            )
            for family in families
        ]
        for number, family in enumerate(families):
            for function, pick in family.picks.items():
                node = self.expr(pick.condition)
                self.tables.picks[6 * function : 6 * function + 6] = (
                    number, pick.slot, pick.low, pick.high, node, pick.default,
                )  # fmt: skip

    def _pointer(self, slot: int, forgettings: Sequence[Forgetting]) -> Pointer:
        owners = [
            number
            for number, forgetting in enumerate(forgettings)
            if any(slot == reset for resets in forgetting.resets.values() for reset, _ in resets)
        ]
        return slot, self._network.variables[slot].initial, owners

    def _forgetting(
        self, process: Process, forgetting: Forgetting
    ) -> tuple[list[int], int, list[int]]:
        if not forgetting.resets:
            return [], 0, []
        controls: list[int] = []
        strides: list[int] = []
        stride = 1
        for slot in forgetting.controls:
            variable = self._network.variables[slot]
            controls += [slot, variable.low, stride]
            strides.append(stride)
            stride *= variable.high - variable.low + 1
        places = [NONE] * (len(process.locations) * stride)
        for (location, values), resets in forgetting.resets.items():
            place = location * stride
            for value, low, step in zip(values, controls[1::3], strides, strict=True):
                place += (value - low) * step
            flat = [number for pair in resets for number in pair]
            places[place] = self._list([len(resets), *flat])
        return controls, stride, places

    def _lower_network(self) -> None:
        tables = self.tables
        for variable in self._network.variables:
            tables.variables += [variable.low, variable.high]
        tables.initial = [process.initial for process in self._network.processes]
        tables.initial += [variable.initial for variable in self._network.variables]
        tables.channels = [
            channel.is_broadcast + 2 * channel.is_urgent for channel in self._network.channels
        ]
        for function in self._network.functions:
            tables.functions += [function.frame, self._block(function.body)]
        for number, process in enumerate(self._network.processes):
            tables.locations.append(
                [location.is_urgent + 2 * location.is_committed for location in process.locations]
            )
            for edge in process.edges:
                tables.edges += self._edge(number, edge)

    def _edge(self, process: int, edge: Edge) -> list[int]:
        guard = NONE if edge.guard is None else self.expr(edge.guard)
        sync = [0, 0, 0, NONE]
        if edge.sync is not None:
            is_fixed = edge.sync.length == 1
            index = NONE if is_fixed else self.expr(edge.sync.index)
            sync = [_SYNC[edge.sync.direction], edge.sync.base, edge.sync.length, index]
        updates = NONE
        if edge.updates:
            nodes = [self.expr(update) for update in edge.updates]
            updates = self._list([len(nodes), *nodes])
        return [process, edge.source, edge.target, guard, *sync, updates]

    # -- nodes ---------------------------------------------------------------------------
    def expr(self, expr: Expr) -> int:
        """Return the node of an expression; the same object is lowered once."""
        known = self._known.get(id(expr))
        if known is None:
            known = self._known[id(expr)] = expr, self._handlers[type(expr)](expr)
        return known[1]

    def _node(self, operation: str, a: int = 0, b: int = 0, c: int = 0) -> int:
        nodes = self.tables.nodes
        nodes += (self._numbers[operation], a, b, c)
        return len(nodes) // 4 - 1

    def _list(self, values: Sequence[int]) -> int:
        self.tables.lists += values
        return len(self.tables.lists) - len(values)

    def _range(self, low: int, high: int) -> int:
        self.tables.ranges += (low, high)
        return len(self.tables.ranges) // 2 - 1

    def _binary(self, node: Binary) -> int:
        if node.op is Op.EQ and isinstance(node.left, Var) and isinstance(node.right, Const):
            return self._node('VAR_IS', node.left.slot, node.right.low)
        return self._node(node.op.name, self.expr(node.left), self.expr(node.right))

    def _check(self, node: Check) -> int:
        operand = self.expr(node.operand)
        if node.is_zero_bad:
            return self._node('CHECK_NONZERO', operand, node.site)
        return self._node('CHECK', operand, node.site, self._range(node.low, node.high))

    def _call(self, node: Call) -> int:
        arguments = [self.expr(argument) for argument in node.arguments]
        return self._node('CALL', node.function, self._list(arguments), len(arguments))

    def _assign(self, node: Assign) -> int:
        value, target = self.expr(node.value), node.target
        if isinstance(target, Var):
            return self._node('ASSIGN_VAR', target.slot, value)
        if isinstance(target, Local):
            return self._node('ASSIGN_LOCAL', target.slot, value)
        operation = 'ASSIGN_ELEMENT' if isinstance(target, Element) else 'ASSIGN_LOCAL_ELEMENT'
        return self._node(operation, target.base, self.expr(target.index), value)

    # -- statements ----------------------------------------------------------------------
    def _block(self, body: Sequence[Stmt]) -> int:
        nodes = [self._statement(statement) for statement in body]
        return self._list([len(nodes), *nodes])

    def _statement(self, node: Stmt) -> int:
        if isinstance(node, Evaluate):
            return self._node('EVALUATE', self.expr(node.expr))
        if isinstance(node, Return):
            return self._node('RETURN', NONE if node.value is None else self.expr(node.value))
        if isinstance(node, If):
            then, otherwise = self._block(node.then), self._block(node.otherwise)
            return self._node('IF', self.expr(node.condition), then, otherwise)
        if isinstance(node, ForRange):
            span = self._range(node.low, node.high)
            return self._node('FOR', node.slot, span, self._block(node.body))
        return self._node('WHILE', self.expr(node.condition), self._block(node.body))
