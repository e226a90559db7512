"""Texts of generator functions: where they give items."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk

_DEFINED = (ast.FunctionDef, ast.AsyncFunctionDef)
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def yields(node: ast.AST) -> bool:
    """Whether a ``yield`` stands in a function or a statement, and in no function inside."""
    waiting: list[ast.AST] = [*node.body] if isinstance(node, _DEFINED) else [node]
    while waiting:
        part = waiting.pop()
        if isinstance(part, (ast.Yield, ast.YieldFrom)):
            return True
        if not isinstance(part, _INNER):
            waiting.extend(ast.iter_child_nodes(part))
    return False


def first_yield(function: ast.AST) -> ast.expr | None:
    """The ``yield`` that the body comes to first, whatever its branches ask, if there is one."""
    return noted_on(function, 'first_yield', _first_yield)


def _first_yield(node: ast.AST) -> ast.expr | None:
    body: Any = getattr(node, 'body', ())
    while True:
        statement = next((each for each in body if yields(each)), None)
        if isinstance(statement, ast.While) and getattr(statement.test, 'value', False) is True:
            body = statement.body
            continue
        value = getattr(statement, 'value', None)
        return value if isinstance(value, ast.Yield) else None


def yields_each_round(body: Sequence[ast.stmt]) -> bool:
    """Whether no round of a loop with this body ends without a ``yield``."""
    skips = (isinstance(part, ast.Continue) for each in body for part in walk(each))
    return _surely_yields(body) and not any(skips)


def _surely_yields(body: Sequence[ast.stmt]) -> bool:
    return any(map(_statement_yields, body))


def _statement_yields(node: ast.stmt) -> bool:
    if isinstance(node, ast.If):
        return _surely_yields(node.body) and _surely_yields(node.orelse)
    if isinstance(node, (ast.With, ast.Try)):
        return _surely_yields(node.body)
    is_open = any(isinstance(part, (ast.BoolOp, ast.IfExp)) for part in walk(node))
    return not (is_open or hasattr(node, 'body') or isinstance(node, ast.Match)) and yields(node)
