"""What expressions and functions contain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.checker.network.network import (
    Assign,
    Binary,
    Call,
    Check,
    Choice,
    DeadlockAtom,
    Element,
    Evaluate,
    Expr,
    ForRange,
    Function,
    If,
    LocalElement,
    Return,
    Stmt,
    Table,
    Unary,
    While,
)


def children(expr: Expr) -> tuple[Expr, ...]:
    """Return the direct subexpressions."""
    if isinstance(expr, (Element, Table, LocalElement)):
        return (expr.index,)
    if isinstance(expr, (Unary, Check)):
        return (expr.operand,)
    if isinstance(expr, Binary):
        return expr.left, expr.right
    if isinstance(expr, Choice):
        return expr.condition, expr.then, expr.otherwise
    if isinstance(expr, Call):
        return expr.arguments
    if isinstance(expr, Assign):
        return expr.target, expr.value
    return ()


def walk(expr: Expr) -> list[Expr]:
    """Return the expression and all below it."""
    found, waiting = [], [expr]
    while waiting:
        node = waiting.pop()
        found.append(node)
        waiting.extend(children(node))
    return found


def has_effect(expr: Expr, functions: Sequence[Function]) -> bool:
    """Whether evaluating assigns anything."""
    return any(
        isinstance(node, Assign) or (isinstance(node, Call) and functions[node.function].writes)
        for node in walk(expr)
    )


def function_expressions(body: Sequence[Stmt]) -> Iterator[Expr]:
    """Yield the expressions of all statements, in order."""
    for node in body:
        if isinstance(node, Evaluate):
            yield node.expr
        elif isinstance(node, Return):
            if node.value is not None:
                yield node.value
        elif isinstance(node, If):
            yield node.condition
            yield from function_expressions((*node.then, *node.otherwise))
        elif isinstance(node, While):
            yield node.condition
            yield from function_expressions(node.body)
        else:
            yield from function_expressions(node.body)


def _statements(body: Sequence[Stmt]) -> Iterator[Stmt]:
    for node in body:
        yield node
        if isinstance(node, If):
            yield from _statements((*node.then, *node.otherwise))
        elif isinstance(node, (While, ForRange)):
            yield from _statements(node.body)


def calls_of(function: Function) -> set[int]:
    """Return the numbers of the functions that a function calls itself."""
    return {
        node.function
        for expr in function_expressions(function.body)
        for node in walk(expr)
        if isinstance(node, Call)
    }


def has_passes(function: Function) -> bool:
    """Whether a call may run through a loop, or call another function."""
    is_loop = (isinstance(node, (While, ForRange)) for node in _statements(function.body))
    return any(is_loop) or bool(calls_of(function))


def mentions_deadlock(expr: Expr) -> bool:
    """Whether the value depends on whether the state is a deadlock."""
    return any(isinstance(node, DeadlockAtom) for node in walk(expr))
