"""What edges and predicates read and write, in the order in which they do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from ros2cc_extract.checker.network import (
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
from ros2cc_extract.checker.walks import children, function_expressions, walk


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


def effect_of(expr: Expr, network: Network) -> Effect:
    """Return what an expression reads and writes."""
    effect = Effect()
    _collect(expr, network, effect, set())
    if isinstance(expr, Assign) and isinstance(expr.target, Var):
        effect.writes.add(expr.target.slot)
    return effect


def _collect(expr: Expr, network: Network, effect: Effect, entered: set[int]) -> None:
    if isinstance(expr, Assign):
        target = expr.target
        _collect(expr.value, network, effect, entered)
        if isinstance(target, (Var, Element)):
            effect.may_write.update(slots_of(target))
        for inner in children(target):
            _collect(inner, network, effect, entered)
        return
    if isinstance(expr, (Var, Element)):
        effect.reads.update(slots_of(expr))
    elif isinstance(expr, Call) and expr.function not in entered:
        entered.add(expr.function)
        for inner in function_expressions(network.functions[expr.function].body):
            _collect(inner, network, effect, entered)
    for inner in children(expr):
        _collect(inner, network, effect, entered)


def edge_effect(edge: Edge, network: Network) -> Effect:
    """Return what an edge as a whole may read and write."""
    total = Effect()
    exprs = [edge.guard, edge.sync.index if edge.sync else None, *edge.updates]
    for expr in exprs:
        if expr is not None:
            part = effect_of(expr, network)
            total.reads |= part.reads
            total.may_write |= part.may_write
    return total


#: An expression and whether it must be true or false.
Literal = tuple[Expr, bool]


@dataclass(frozen=True)
class ConditionalRead:
    """A predicate reads a variable only where all literals hold."""

    slot: int
    literals: frozenset[Literal]


def conditional_reads(predicates: Iterable[Expr], network: Network) -> set[ConditionalRead]:
    """Return the reads of all predicates, with the conditions under which they matter."""
    found: set[ConditionalRead] = set()
    for predicate in predicates:
        found.update(_reads(predicate, frozenset(), network))
    return found


def _reads(
    expr: Expr, literals: frozenset[Literal], network: Network
) -> Iterator[ConditionalRead]:
    if isinstance(expr, Binary) and expr.op in (Op.AND, Op.OR):
        # Only the right side depends on the left one, as it is evaluated: if each were said to
        # matter only where the other holds, both could be forgotten at once.
        wanted = expr.op is Op.AND
        yield from _reads(expr.left, literals, network)
        yield from _reads(expr.right, literals | implied(expr.left, wanted), network)
        return
    if isinstance(expr, Choice):
        yield from _reads(expr.condition, literals, network)
        yield from _reads(expr.then, literals | implied(expr.condition, True), network)
        yield from _reads(expr.otherwise, literals | implied(expr.condition, False), network)
        return
    if isinstance(expr, Call):
        for slot in effect_of(expr, network).reads:
            yield ConditionalRead(slot, literals)
        return
    if isinstance(expr, (Var, Element)):
        for slot in slots_of(expr):
            yield ConditionalRead(slot, literals)
    for inner in children(expr):
        yield from _reads(inner, literals, network)


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
