"""
Functions that begin anew by calling themselves: loops, written as recursion.

``if self.pose is None: time.sleep(0.1); return self.go()`` waits as a ``while`` does, and so does
a handler that ends in ``self.connect()``, until Python raises ``RecursionError``. Only calls that
hand on all parameters as they are, with nothing to be done behind them, are such.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

from ros2cc_extract.extract.static.program.text_queries import RECURSION, noted_on, walk

Function = ast.FunctionDef | ast.AsyncFunctionDef


def body_of(function: Function) -> list[ast.stmt]:
    """The statements of a function, with a loop where it begins anew."""
    return noted_on(function, 'as_loop', _unrolled)


def _unrolled(function: Function) -> list[ast.stmt]:
    for at, statement in enumerate(function.body):
        before, behind = function.body[:at], function.body[at + 1 :]
        if isinstance(statement, ast.If) and _begins_anew(statement.body, function, behind):
            tests = ast.UnaryOp(ast.Not(), statement.test)
            leaves = ast.If(tests, [ast.Break()], [])
            for part in (tests, leaves, leaves.body[0]):
                ast.copy_location(part, statement.test)
            inside = [*before, leaves, *statement.body[:-1]]
            return [_loop(inside, statement), *statement.orelse, *behind]
        if isinstance(statement, ast.Try):
            attempt = _attempt(statement, function, behind)
            if attempt is not None:
                return [_loop([*before, attempt], statement), *behind]
    return function.body


def _attempt(statement: ast.Try, function: Function, behind: Sequence[ast.stmt]) -> ast.Try | None:
    """The same attempt, which leaves a loop where no handler begins anew."""
    anew = [_begins_anew(handler.body, function, behind) for handler in statement.handlers]
    if not any(anew) or statement.finalbody:
        return None
    leaves = ast.copy_location(ast.Break(), statement)
    handlers = [
        ast.copy_location(
            ast.ExceptHandler(
                handler.type,
                handler.name,
                handler.body[:-1] if begins else [*handler.body, leaves],
            ),
            handler,
        )
        for handler, begins in zip(statement.handlers, anew, strict=True)
    ]
    made = ast.Try(statement.body, handlers, [*statement.orelse, leaves], [])
    return ast.copy_location(made, statement)


def _loop(inside: list[ast.stmt], at: ast.stmt) -> ast.While:
    test = ast.copy_location(ast.Constant(True, kind=RECURSION), at)
    return ast.copy_location(ast.While(test, inside, []), at)


def _begins_anew(
    block: Sequence[ast.stmt], function: Function, behind: Sequence[ast.stmt]
) -> bool:
    """Whether a block ends in a call of the function itself, and nothing is done after it."""
    last = block[-1] if block else None
    is_end = isinstance(last, ast.Return) or (isinstance(last, ast.Expr) and not behind)
    call = last.value if is_end and isinstance(last, (ast.Return, ast.Expr)) else None
    return isinstance(call, ast.Call) and _hands_on_all(call, function)


def _hands_on_all(call: ast.Call, function: Function) -> bool:
    given = function.args
    names = [each.arg for each in (*given.posonlyargs, *given.args)]
    called = call.func
    if isinstance(called, ast.Attribute):
        is_own = isinstance(called.value, ast.Name) and names[:1] == [called.value.id]
        is_own, names = is_own and called.attr == function.name, names[1:]
    else:
        is_own = isinstance(called, ast.Name) and called.id == function.name
    handed = [each.id if isinstance(each, ast.Name) else '' for each in call.args]
    by_name = {each.arg: each.value for each in call.keywords}
    handed += [
        name
        for name in names[len(handed) :]
        if isinstance(value := by_name.pop(name, None), ast.Name) and value.id == name
    ]
    is_plain = not (by_name or given.vararg or given.kwonlyargs or given.kwarg)
    return is_own and is_plain and handed == names and not _stores(function, names)


def _stores(function: Function, names: Sequence[str]) -> bool:
    return any(
        isinstance(part, ast.Name) and part.id in names and not isinstance(part.ctx, ast.Load)
        for part in walk(function)
    )
