"""
Calls that a loop repeats until they succeed, with or without a time-out of each.

``while not client.wait_for_service(timeout_sec=1.0): log()``, or the answer is kept in a name that
the loop asks, or an ``if`` inside of an endless loop leaves it. A loop that something else may
leave does not count.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.source_locations import Place

_LEAVING = (ast.Break, ast.Return, ast.Raise)


def is_retried(function: ast.AST, place: Place) -> bool:
    """Whether the call at ``place`` in a function is tried again until its answer is true."""
    return (place.line, place.column) in noted_on(function, 'retried_calls', _retried_calls)


def _retried_calls(function: ast.AST) -> frozenset[tuple[int, int]]:
    loops = (part for part in walk(function) if isinstance(part, ast.While))
    calls = (call for loop in loops for call in _retried_by(loop))
    return frozenset((call.lineno, call.col_offset + 1) for call in calls)


def _retried_by(loop: ast.While) -> Iterator[ast.Call]:
    leaving = [part for each in loop.body for part in walk(each) if isinstance(part, _LEAVING)]
    if leaving:
        yield from _left_by_test(loop, leaving)
        return
    is_all = isinstance(loop.test, ast.BoolOp) and isinstance(loop.test.op, ast.And)
    tests = loop.test.values if is_all else [loop.test]  # type: ignore[attr-defined]
    asked = [test for test in tests if not _is_ok(test)]
    if len(asked) != 1 or not isinstance(asked[0], ast.UnaryOp):
        return
    answer = asked[0].operand
    if isinstance(asked[0].op, ast.Not) and isinstance(answer, ast.Call):
        yield answer
    elif isinstance(asked[0].op, ast.Not) and isinstance(answer, ast.Name):
        stored = [value for each in loop.body for value in _stored_in(answer.id, each)]
        if len(stored) == 1 and isinstance(stored[0], ast.Call):
            yield stored[0]


def _left_by_test(loop: ast.While, leaving: Sequence[ast.AST]) -> Iterator[ast.Call]:
    """The call whose answer alone makes an endless loop end."""
    is_endless = _is_ok(loop.test) or (isinstance(loop.test, ast.Constant) and loop.test.value)
    for statement in loop.body if is_endless else ():
        if isinstance(statement, ast.If) and isinstance(statement.test, ast.Call):
            inside = [part for each in statement.body for part in walk(each)]
            if all(any(part is each for each in inside) for part in leaving):
                yield statement.test


def _is_ok(test: ast.expr) -> bool:
    """``rclpy.ok()``, as long as the program runs."""
    called = test.func if isinstance(test, ast.Call) else None
    return isinstance(called, ast.Attribute) and called.attr == 'ok'


def _stored_in(name: str, statement: ast.stmt) -> Iterator[ast.expr | None]:
    for part in walk(statement):
        if isinstance(part, ast.Assign) and any(_is_name(each, name) for each in part.targets):
            yield part.value
        elif isinstance(part, (ast.AugAssign, ast.AnnAssign, ast.For, ast.NamedExpr)):
            yield from [None] if _is_name(part.target, name) else []


def _is_name(target: ast.expr, name: str) -> bool:
    return isinstance(target, ast.Name) and target.id == name
