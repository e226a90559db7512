"""What edges and predicates read and write, in the order in which they do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import field

from ros2cc_extract.checker.network.network import (
    Assign,
    AtLocation,
    Binary,
    Call,
    Choice,
    Const,
    Edge,
    Element,
    Expr,
    Network,
    Op,
    Unary,
    Var,
)
from ros2cc_extract.checker.network.traversal import children, function_expressions, walk
from ros2cc_extract.light_dataclasses import dataclass


def slots_of(target: Element | Var) -> range:
    """Return the slots a target may be."""
    if isinstance(target, Var):
        return range(target.slot, target.slot + 1)
    return range(target.base, target.base + target.length)


@dataclass(eq=False)
class Effect:
    """
    Reads and writes of an expression that is evaluated for its effect.

    :param reads: variables that may be read before this expression writes them.
    :param may_write: variables that may be written.
    :param writes: variables that are written whenever it is evaluated.
    """

    reads: set[int] = field(default_factory=set)
    may_write: set[int] = field(default_factory=set)
    writes: set[int] = field(default_factory=set)


class Effects:
    """Effects of the expressions of one network; those of its functions are kept."""

    def __init__(self, network: Network) -> None:
        self._network = network
        self._of_function: dict[int, Effect] = {}

    def of(self, expr: Expr) -> Effect:
        """Return what an expression reads and writes."""
        effect = Effect()
        self._collect(expr, effect)
        if isinstance(expr, Assign) and isinstance(expr.target, Var):
            effect.writes.add(expr.target.slot)
        return effect

    def of_edge(self, edge: Edge) -> Effect:
        """Return what an edge as a whole may read and write."""
        total = Effect()
        for expr in (edge.guard, edge.sync.index if edge.sync else None, *edge.updates):
            if expr is not None:
                self._collect(expr, total)
        return total

    def _collect(self, expr: Expr, effect: Effect) -> None:
        if isinstance(expr, Assign):
            target = expr.target
            self._collect(expr.value, effect)
            if isinstance(target, (Var, Element)):
                effect.may_write.update(slots_of(target))
            for inner in children(target):
                self._collect(inner, effect)
            return
        if isinstance(expr, (Var, Element)):
            effect.reads.update(slots_of(expr))
        elif isinstance(expr, Call):
            called = self._function(expr.function)
            effect.reads |= called.reads
            effect.may_write |= called.may_write
        for inner in children(expr):
            self._collect(inner, effect)

    def _function(self, number: int) -> Effect:
        # Functions do not call themselves, so this ends.
        if number not in self._of_function:
            effect = Effect()
            for inner in function_expressions(self._network.functions[number].body):
                self._collect(inner, effect)
            self._of_function[number] = effect
        return self._of_function[number]


#: An expression and whether it must be true or false.
Literal = tuple[Expr, bool]


@dataclass(frozen=True)
class ConditionalRead:
    """A predicate reads a variable only where all literals hold."""

    slot: int
    literals: frozenset[Literal]


def conditional_reads(predicates: Iterable[Expr], effects: Effects) -> set[ConditionalRead]:
    """Return the reads of all predicates, with the conditions under which they matter."""
    found: set[ConditionalRead] = set()
    for predicate in predicates:
        found.update(_reads(predicate, frozenset(), effects))
    return found


def _reads(
    expr: Expr, literals: frozenset[Literal], effects: Effects
) -> Iterator[ConditionalRead]:
    if isinstance(expr, Binary) and expr.op in (Op.AND, Op.OR):
        # Only the right side depends on the left one, as it is evaluated: if each were said to
        # matter only where the other holds, both could be forgotten at once.
        wanted = expr.op is Op.AND
        yield from _reads(expr.left, literals, effects)
        yield from _reads(expr.right, literals | implied(expr.left, wanted), effects)
        return
    if isinstance(expr, Choice):
        yield from _reads(expr.condition, literals, effects)
        yield from _reads(expr.then, literals | implied(expr.condition, True), effects)
        yield from _reads(expr.otherwise, literals | implied(expr.condition, False), effects)
        return
    if isinstance(expr, Call):
        for slot in effects.of(expr).reads:
            yield ConditionalRead(slot, literals)
        return
    if isinstance(expr, (Var, Element)):
        for slot in slots_of(expr):
            yield ConditionalRead(slot, literals)
    for inner in children(expr):
        yield from _reads(inner, literals, effects)


def implied(expr: Expr, value: bool) -> frozenset[Literal]:
    """Return literals that hold whenever the expression is true (or false)."""
    if isinstance(expr, Unary) and expr.op is Op.NOT:
        return implied(expr.operand, not value)
    if isinstance(expr, Binary) and expr.op is (Op.AND if value else Op.OR):
        return implied(expr.left, value) | implied(expr.right, value)
    if isinstance(expr, (Var, AtLocation)) or _is_comparison(expr):
        return frozenset({(expr, value)})
    return frozenset()


def _is_comparison(expr: Expr) -> bool:
    return (
        isinstance(expr, Binary)
        and expr.op in (Op.EQ, Op.NE)
        and isinstance(expr.left, Var)
        and isinstance(expr.right, Const)
    )


def variables_of(expr: Expr) -> set[int]:
    """Return the plain variables in an expression."""
    return {node.slot for node in walk(expr) if isinstance(node, Var)}
