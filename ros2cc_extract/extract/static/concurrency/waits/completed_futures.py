"""
Futures that the text shows to be done where their result is asked for.

``if future.done(): future.result()`` and ``await future`` before ``future.result()`` do not wait,
for any future: none is ever undone (Python 3.11, library reference,
``concurrent.futures``, ``asyncio``; rclpy 7.1.6, ``task.py``).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk

_MARK = 'done_before'
_OF_FUTURES = frozenset(['result', 'exception'])
_INNER = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)
_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)


def is_done_before(call: ast.Call, trees: Sequence[ast.Module]) -> bool:
    """Whether the future of ``call``, which stands in one of ``trees``, is done by then."""
    for tree in trees:
        noted_on(tree, 'done_before_is_marked', _mark_all)
    return _MARK in call.__dict__


def _mark_all(tree: ast.AST) -> bool:
    for part in walk(tree):
        for block in _blocks(part):
            for number, statement in enumerate(block):
                rest = block[number + 1 :]
                for name in _done_after(statement):
                    _mark(rest, name)
                if isinstance(statement, ast.If):
                    for name in _asked(statement.test):
                        _mark(statement.body, name)
    return True


def _blocks(part: ast.AST) -> Iterator[list[ast.stmt]]:
    for field in ('body', 'orelse', 'finalbody'):
        block = getattr(part, field, None)
        if isinstance(block, list):
            yield block


def _done_after(statement: ast.stmt) -> Iterator[str]:
    """Names of futures that are done wherever ``statement`` has been left at its end."""
    if isinstance(statement, (ast.Expr, ast.Assign)) and isinstance(statement.value, ast.Await):
        awaited = statement.value.value
        if isinstance(awaited, ast.Name) and awaited.id not in _stored([statement]):
            yield awaited.id
    if isinstance(statement, ast.If) and not statement.orelse:
        test, is_guard = statement.test, isinstance(statement.body[-1], _LEAVING)
        if is_guard and isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not):
            yield from _asked(test.operand)


def _asked(test: ast.expr) -> Iterator[str]:
    """Names of futures that are done where ``test`` holds."""
    if isinstance(test, ast.BoolOp) and isinstance(test.op, ast.And):
        for part in test.values:
            yield from _asked(part)
    if isinstance(test, ast.Call) and isinstance(test.func, ast.Attribute) and not test.args:
        name = _owner(test)
        if name is not None and test.func.attr == 'done':
            yield name


def _mark(block: Sequence[ast.stmt], name: str) -> None:
    """Mark what asks the future ``name``, as long as the name is not given to another."""
    for statement in block:
        if name in _stored([statement]):
            return
        for part in _run_here(statement):
            if _asks(part, name):
                part.__dict__[_MARK] = True


def _run_here(statement: ast.stmt) -> Iterator[ast.AST]:
    """What stands in ``statement`` and in no function inside of it, which may run much later."""
    waiting: list[ast.AST] = [statement]
    while waiting:
        part = waiting.pop()
        if not isinstance(part, _INNER):
            yield part
            waiting.extend(ast.iter_child_nodes(part))


def _asks(part: ast.AST, name: str) -> bool:
    if not isinstance(part, ast.Call) or _owner(part) != name:
        return False
    return isinstance(part.func, ast.Attribute) and part.func.attr in _OF_FUTURES


def _stored(statements: Sequence[ast.stmt]) -> set[str]:
    return {
        part.id
        for statement in statements
        for part in walk(statement)
        if isinstance(part, ast.Name) and not isinstance(part.ctx, ast.Load)
    }


def _owner(call: ast.Call) -> str | None:
    """The name that a method is called of."""
    function = call.func
    if isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
        return function.value.id
    return None
