"""
Whether exchanging two processes of a template, and all that is theirs, leaves a network as it is.

There are two sorts of values: plain ones, and *names* of processes, which may only be
stored, compared for equality, and used as an index into what is each process's own (scalarsets:
Ip and Dill, "Better verification through symmetry"). The checks are on syntax, up to the order
of the operands of ``&&``, ``||`` and ``+``, into which quantifiers over all processes unfold.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import Any

from ros2cc_extract.checker.network.network import (
    Assign,
    AtLocation,
    Binary,
    Call,
    Check,
    Choice,
    Const,
    DeadlockAtom,
    Edge,
    Element,
    Evaluate,
    Expr,
    ForRange,
    Function,
    If,
    Local,
    LocalElement,
    Network,
    Op,
    Return,
    Stmt,
    Sync,
    Table,
    Unary,
    Var,
    While,
)
from ros2cc_extract.checker.network.traversal import walk
from ros2cc_extract.light_dataclasses import dataclass

_COMMUTING = (Op.AND, Op.OR, Op.ADD)


@dataclass(frozen=True)
class Pick:
    """
    A function that returns the lowest name for which a condition holds.

    :param slot: the local that stands for the name in the condition.
    :param default: what is returned where it holds for none.
    """

    slot: int
    low: int
    high: int
    condition: Expr
    default: int


def pick_of(function: Function) -> Pick | None:
    """Return what a function picks, if it is ``for (t : T) if (…) return t; return 0;``."""
    body = function.body
    if len(body) != 2 or not isinstance(body[0], ForRange) or not isinstance(body[1], Return):
        return None
    loop, last = body[0], body[1]
    if len(loop.body) != 1 or not isinstance(loop.body[0], If) or loop.body[0].otherwise:
        return None
    branch = loop.body[0]
    if len(branch.then) != 1 or not isinstance(branch.then[0], Return):
        return None
    chosen = branch.then[0].value
    if not isinstance(chosen, Local) or chosen.slot != loop.slot:
        return None
    if not isinstance(last.value, Const) or not 0 <= loop.low <= loop.high < 64:
        return None
    if any(isinstance(node, (Assign, Call, Check)) for node in walk(branch.condition)):
        return None
    return Pick(loop.slot, loop.low, loop.high, branch.condition, last.value.low)


@dataclass(eq=False)
class Exchange:
    """
    The exchange of two processes.

    :param names: how other processes and arrays call the two; None if none does.
    :param slots: variables that change places, each to the other.
    :param channels: the same for channels.
    :param pointers: variables whose value is a name.
    """

    processes: tuple[int, int]
    names: tuple[int, int] | None
    slots: dict[int, int]
    channels: dict[int, int]
    pointers: set[int] = field(default_factory=set)

    def process(self, number: int) -> int:
        """Return which process stands where this one stood."""
        first, second = self.processes
        return {first: second, second: first}.get(number, number)

    def name(self, value: int) -> int:
        """Return the name that a name becomes."""
        first, second = self.names or (value, value)
        return {first: second, second: first}.get(value, value)


@dataclass(eq=False)
class Equivariance:
    """
    Compares parts of a network with what an exchange makes of other parts.

    :param picks: functions that pick a name, by number; filled as they are met.
    """

    network: Network
    exchange: Exchange
    picks: dict[int, Pick] = field(default_factory=dict)
    _functions: dict[tuple[int, int, bool], bool] = field(default_factory=dict)
    _may_pick: bool = False
    #: Locals of the function under comparison that hold a name.
    _named: set[int] = field(default_factory=set)

    # -- edges ---------------------------------------------------------------------------
    def same_edges(self, edges: Sequence[Edge], others: Sequence[Edge]) -> bool:
        """Whether the exchange turns the first edges into the others, in any order."""
        if len(edges) != len(others):
            return False
        left = list(others)
        for index, edge in enumerate(edges):
            # The edges of two instances of a template stand in one order, nearly always.
            near = sorted(
                range(len(left)), key=lambda k: abs(k - (index - len(edges) + len(left)))
            )
            found = next((k for k in near if self._same_edge(edge, left[k])), None)
            if found is None:
                return False
            del left[found]
        return True

    def _same_edge(self, a: Edge, b: Edge) -> bool:
        if (a.source, a.target, len(a.updates)) != (b.source, b.target, len(b.updates)):
            return False
        if (a.guard is None) is not (b.guard is None) or not self._same_sync(a.sync, b.sync):
            return False
        if a.guard is not None and b.guard is not None and not self.same(a.guard, b.guard):
            return False
        self._may_pick = True
        try:
            return all(map(self.same, a.updates, b.updates))
        finally:
            self._may_pick = False

    def _same_sync(self, a: Sync | None, b: Sync | None) -> bool:
        if a is None or b is None:
            return a is b
        if a.direction is not b.direction or a.length != b.length:
            return False
        if a.length == 1:
            return self.exchange.channels.get(a.base, a.base) == b.base
        if a.base != b.base:
            return False
        whole = range(a.base, a.base + a.length)
        if not any(channel in self.exchange.channels for channel in whole):
            return self.same(a.index, b.index)
        if not self._is_array_of_names(whole, self.exchange.channels):
            return False
        self._may_pick = a.direction.value == '!'
        try:
            return self._same_name(a.index, b.index)
        finally:
            self._may_pick = False

    # -- plain values --------------------------------------------------------------------
    def same(self, a: Expr, b: Expr) -> bool:
        """Whether the exchange turns the first expression into the second; both are plain."""
        if type(a) is not type(b):
            return False
        handler = _HANDLERS.get(type(a))
        return handler is not None and handler(self, a, b)

    def _const(self, a: Const, b: Const) -> bool:
        return a.low == b.low

    def _var(self, a: Var, b: Var) -> bool:
        if a.slot in self.exchange.pointers:
            return False
        return self.exchange.slots.get(a.slot, a.slot) == b.slot

    def _element(self, a: Element, b: Element) -> bool:
        whole = range(a.base, a.base + a.length)
        if a.length != b.length or any(slot in self.exchange.pointers for slot in whole):
            return False
        if a.base != b.base:
            moved = [self.exchange.slots.get(slot) for slot in whole]
            return moved == [*range(b.base, b.base + b.length)] and self.same(a.index, b.index)
        if not any(slot in self.exchange.slots for slot in whole):
            return self.same(a.index, b.index)
        is_fit = self._is_array_of_names(whole, self.exchange.slots)
        return is_fit and self._same_name(a.index, b.index)

    def _is_array_of_names(self, whole: range, moved: Mapping[int, int]) -> bool:
        if self.exchange.names is None:
            return False
        first, second = (whole.start + name for name in self.exchange.names)
        return {number for number in whole if number in moved} == {first, second} and (
            moved[first] == second
        )

    def _table(self, a: Table, b: Table) -> bool:
        return a.values == b.values and self.same(a.index, b.index)

    def _local(self, a: Local, b: Local) -> bool:
        return a.slot == b.slot and a.slot not in self._named

    def _local_element(self, a: LocalElement, b: LocalElement) -> bool:
        whole = range(a.base, a.base + a.length)
        if any(slot in self._named for slot in whole):
            return False
        return (a.base, a.length) == (b.base, b.length) and self.same(a.index, b.index)

    def _unary(self, a: Unary, b: Unary) -> bool:
        return a.op is b.op and self.same(a.operand, b.operand)

    def _binary(self, a: Binary, b: Binary) -> bool:
        if a.op is not b.op:
            return False
        if a.op in (Op.EQ, Op.NE) and (self._is_name(a.left) or self._is_name(a.right)):
            return self._same_name(a.left, b.left) and self._same_name(a.right, b.right)
        if self.same(a.left, b.left) and self.same(a.right, b.right):
            return True
        return a.op in _COMMUTING and self._same_in_any_order(
            _operands(a.op, a), _operands(b.op, b)
        )

    def _same_in_any_order(self, some: list[Expr], others: list[Expr]) -> bool:
        # A check that fails, or a loop that does not end, depends on the order.
        if len(some) != len(others) or any(map(_may_fail, (*some, *others))):
            return False
        left = set(range(len(others)))
        for place, operand in enumerate(some):
            # Most stand where they stood; the two that are exchanged stand elsewhere.
            near = (place, *left) if place in left else left
            found = next((k for k in near if self.same(operand, others[k])), None)
            if found is None:
                return False
            left.remove(found)
        return True

    def _choice(self, a: Choice, b: Choice) -> bool:
        pairs = ((a.condition, b.condition), (a.then, b.then), (a.otherwise, b.otherwise))
        return all(self.same(one, other) for one, other in pairs)

    def _check(self, a: Check, b: Check) -> bool:
        bounds = (a.low, a.high, a.is_zero_bad) == (b.low, b.high, b.is_zero_bad)
        return bounds and self.same(a.operand, b.operand)

    def _call(self, a: Call, b: Call) -> bool:
        if len(a.arguments) != len(b.arguments):
            return False
        if not all(map(self.same, a.arguments, b.arguments)):
            return False
        return self._same_function(a.function, b.function)

    def _assign(self, a: Assign, b: Assign) -> bool:
        if isinstance(a.target, Var) and a.target.slot in self.exchange.pointers:
            is_same = isinstance(b.target, Var) and a.target.slot == b.target.slot
            return is_same and self._same_name(a.value, b.value)
        return self.same(a.target, b.target) and self.same(a.value, b.value)

    def _at_location(self, a: AtLocation, b: AtLocation) -> bool:
        return a.location == b.location and self.exchange.process(a.process) == b.process

    def _deadlock(self, a: DeadlockAtom, b: DeadlockAtom) -> bool:
        return True

    # -- names ---------------------------------------------------------------------------
    def _is_name(self, expr: Expr) -> bool:
        if isinstance(expr, Check):
            return self._is_name(expr.operand)
        if isinstance(expr, Local):
            return expr.slot in self._named
        return isinstance(expr, Var) and expr.slot in self.exchange.pointers

    def _same_name(self, a: Expr, b: Expr) -> bool:
        names = self.exchange.names
        if names is None:
            return False
        if isinstance(a, Const):
            return isinstance(b, Const) and self.exchange.name(a.low) == b.low
        if isinstance(a, Check) and isinstance(b, Check):
            bounds = (a.low, a.high, a.is_zero_bad) == (b.low, b.high, b.is_zero_bad)
            is_fair = not a.is_zero_bad and all(a.low <= name <= a.high for name in names)
            return bounds and is_fair and self._same_name(a.operand, b.operand)
        if isinstance(a, Call) and isinstance(b, Call):
            return self._same_pick(a, b)
        same_kind = type(a) is type(b) and self._is_name(a)
        return same_kind and isinstance(a, (Var, Local)) and a.slot == getattr(b, 'slot', None)

    def _same_pick(self, a: Call, b: Call) -> bool:
        if not self._may_pick or self._named or a.function != b.function or a.arguments:
            return False
        pick = pick_of(self.network.functions[a.function])
        if pick is None or not self._is_fair_pick(pick):
            return False
        self.picks[a.function] = pick
        return True

    def _is_fair_pick(self, pick: Pick) -> bool:
        names = self.exchange.names or ()
        covers_both = all(pick.low <= name <= pick.high for name in names)
        self._named = {pick.slot}
        try:
            return covers_both and self.same(pick.condition, pick.condition)
        finally:
            self._named = set()

    # -- functions -----------------------------------------------------------------------
    def _same_function(self, a: int, b: int) -> bool:
        key = a, b, self._may_pick
        if key not in self._functions:
            one, other = self.network.functions[a], self.network.functions[b]
            shape = (one.parameters, one.frame) == (other.parameters, other.frame)
            self._functions[key] = shape and self._same_block(one.body, other.body)
        return self._functions[key]

    def _same_block(self, a: Sequence[Stmt], b: Sequence[Stmt]) -> bool:
        return len(a) == len(b) and all(map(self._same_statement, a, b))

    def _same_statement(self, a: Stmt, b: Stmt) -> bool:
        if isinstance(a, Evaluate):
            return isinstance(b, Evaluate) and self.same(a.expr, b.expr)
        if isinstance(a, If):
            return isinstance(b, If) and (
                self.same(a.condition, b.condition)
                and self._same_block(a.then, b.then)
                and self._same_block(a.otherwise, b.otherwise)
            )
        if isinstance(a, While):
            is_same = isinstance(b, While) and self.same(a.condition, b.condition)
            return is_same and isinstance(b, While) and self._same_block(a.body, b.body)
        if isinstance(a, ForRange):
            return isinstance(b, ForRange) and (
                (a.slot, a.low, a.high) == (b.slot, b.low, b.high)
                and self._same_block(a.body, b.body)
            )
        if not isinstance(b, Return) or a.value is None or b.value is None:
            return isinstance(b, Return) and a.value is b.value
        return self.same(a.value, b.value)


_HANDLERS: dict[type, Callable[[Any, Any, Any], bool]] = {
    Const: Equivariance._const,
    Var: Equivariance._var,
    Element: Equivariance._element,
    Table: Equivariance._table,
    Local: Equivariance._local,
    LocalElement: Equivariance._local_element,
    Unary: Equivariance._unary,
    Binary: Equivariance._binary,
    Choice: Equivariance._choice,
    Check: Equivariance._check,
    Call: Equivariance._call,
    Assign: Equivariance._assign,
    AtLocation: Equivariance._at_location,
    DeadlockAtom: Equivariance._deadlock,
}


def _operands(op: Op, expr: Expr) -> list[Expr]:
    if isinstance(expr, Binary) and expr.op is op:
        return _operands(op, expr.left) + _operands(op, expr.right)
    return [expr]


def _may_fail(expr: Expr) -> bool:
    return any(isinstance(node, (Check, Call, Assign)) for node in walk(expr))
