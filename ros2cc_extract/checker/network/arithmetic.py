"""Builds checked, folded expressions: constants are evaluated, intervals followed."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ros2cc_extract.checker.network.network import (
    INT32,
    Binary,
    Choice,
    Const,
    Expr,
    Local,
    Op,
    Unary,
    Var,
)

BY_SPELLING = {op.value: op for op in Op if op is not Op.NEG}
TRUE, FALSE = Const(1, 1), Const(0, 0)


def const(value: int) -> Const:
    """Return a constant."""
    return Const(value, value)


def _quotient(a: int, b: int) -> int:
    result = abs(a) // abs(b)
    return result if (a < 0) == (b < 0) else -result


OPERATIONS: dict[Op, Callable[[int, int], int]] = {
    Op.ADD: lambda a, b: a + b,
    Op.SUB: lambda a, b: a - b,
    Op.MUL: lambda a, b: a * b,
    Op.DIV: _quotient,
    Op.MOD: lambda a, b: a - b * _quotient(a, b),
    Op.SHL: lambda a, b: a << b,
    Op.SHR: lambda a, b: a >> b,
    Op.BIT_AND: lambda a, b: a & b,
    Op.BIT_OR: lambda a, b: a | b,
    Op.BIT_XOR: lambda a, b: a ^ b,
    Op.MIN: min,
    Op.MAX: max,
    Op.EQ: lambda a, b: int(a == b),
    Op.NE: lambda a, b: int(a != b),
    Op.LT: lambda a, b: int(a < b),
    Op.LE: lambda a, b: int(a <= b),
    Op.GT: lambda a, b: int(a > b),
    Op.GE: lambda a, b: int(a >= b),
    Op.AND: lambda a, b: int(a != 0 and b != 0),
    Op.OR: lambda a, b: int(a != 0 or b != 0),
}
_NEUTRAL = {Op.ADD: FALSE, Op.SUB: FALSE, Op.MUL: TRUE}
_TRUTH = (Op.EQ, Op.NE, Op.LT, Op.LE, Op.GT, Op.GE, Op.AND, Op.OR)
_AT_CORNERS = (Op.ADD, Op.SUB, Op.MUL, Op.SHL, Op.SHR, Op.MIN, Op.MAX)


def interval(op: Op, left: Expr, right: Expr) -> tuple[int, int]:
    """Return bounds of ``left op right``, given that divisors and shifts are checked."""
    if op in _TRUTH:
        return _truth_interval(op, left, right)
    if op in _AT_CORNERS:
        apply = OPERATIONS[op]
        corners = [apply(a, b) for a in (left.low, left.high) for b in (right.low, right.high)]
        return min(corners), max(corners)
    size = max(abs(left.low), abs(left.high))
    if op is Op.DIV:
        return -size, size
    if op is Op.MOD:
        size = min(size, max(abs(right.low), abs(right.high), 1) - 1)
        return (0 if left.low >= 0 else -size), size
    widest = max(abs(right.low), abs(right.high), size)
    bits = (1 << widest.bit_length()) - 1
    return (0 if min(left.low, right.low) >= 0 else -bits - 1), bits


def _truth_interval(op: Op, left: Expr, right: Expr) -> tuple[int, int]:
    known: bool | None = None
    if op in (Op.LT, Op.GE) and (left.high < right.low or left.low >= right.high):
        known = (left.high < right.low) == (op is Op.LT)
    elif op in (Op.GT, Op.LE) and (left.low > right.high or left.high <= right.low):
        known = (left.low > right.high) == (op is Op.GT)
    elif op in (Op.EQ, Op.NE) and (left.high < right.low or left.low > right.high):
        known = op is Op.NE
    return (0, 1) if known is None else (int(known), int(known))


def binary(op: Op, left: Expr, right: Expr) -> Expr:
    """Combine two expressions; the caller has checked divisors and shifts."""
    if op in (Op.AND, Op.OR):
        return _connective(op, left, right)
    if isinstance(left, Const) and isinstance(right, Const):
        return const(OPERATIONS[op](left.low, right.low))
    if right == _NEUTRAL.get(op):
        return left
    if op in (Op.ADD, Op.MUL) and left == _NEUTRAL[op]:
        return right
    return Binary(*interval(op, left, right), op, left, right)


def _connective(op: Op, left: Expr, right: Expr) -> Expr:
    neutral = op is Op.AND
    if isinstance(left, Const):
        return truth(right) if bool(left.low) is neutral else const(int(not neutral))
    if isinstance(right, Const) and bool(right.low) is neutral:
        return truth(left)
    return Binary(0, 1, op, left, right)


def truth(expr: Expr) -> Expr:
    """Convert to 0 or 1."""
    if expr.low >= 0 and expr.high <= 1:
        return expr
    return binary(Op.NE, expr, FALSE)


def negation(expr: Expr) -> Expr:
    """Return ``!expr``."""
    if isinstance(expr, Const):
        return const(int(not expr.low))
    return Unary(0, 1, Op.NOT, expr)


def minus(expr: Expr) -> Expr:
    """Return ``-expr``."""
    if isinstance(expr, Const):
        return const(-expr.low)
    return Unary(-expr.high, -expr.low, Op.NEG, expr)


def choice(condition: Expr, then: Expr, otherwise: Expr) -> Expr:
    """Return ``condition ? then : otherwise``."""
    if isinstance(condition, Const):
        return then if condition.low else otherwise
    low, high = min(then.low, otherwise.low), max(then.high, otherwise.high)
    return Choice(low, high, condition, then, otherwise)


def folded(op: Op, terms: Sequence[Expr], empty: Expr) -> Expr:
    """Combine many terms by an associative operator, as a balanced tree in their order."""
    level = list(terms)
    while len(level) > 1:
        pairs = [binary(op, level[i], level[i + 1]) for i in range(0, len(level) - 1, 2)]
        level = pairs + level[len(level) - len(level) % 2 :]
    return level[0] if level else empty


def fits_32_bits(expr: Expr) -> bool:
    """Whether no value of the expression leaves 32 bits."""
    return expr.low >= INT32[0] and expr.high <= INT32[1]


def is_atomic(expr: Expr) -> bool:
    """Whether repeating the expression costs nothing."""
    return isinstance(expr, (Const, Var, Local))
