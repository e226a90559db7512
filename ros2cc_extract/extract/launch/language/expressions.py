"""``PythonExpression`` of constants: computed from its syntax tree, never run."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable
from typing import Any

from ros2cc_extract.source_locations import Unknown

_LONGEST = 10_000
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: lambda one, other: operator.mod(one + 0, other),
}
_COMPARE: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda one, other: one in other,
    ast.NotIn: lambda one, other: one not in other,
}
_WORDS = {'true': True, 'false': False}
_CALLS: dict[str, Callable[..., Any]] = {'str': str, 'int': int, 'float': float, 'bool': bool}


class _OpenError(Exception):
    """A part that is not computed."""


def computed(text: str) -> str | Unknown:
    """What Python would give for ``text``, as text."""
    try:
        if len(text) > _LONGEST:
            raise _OpenError
        return str(_value(ast.parse(text.strip(), mode='eval').body))
    except (_OpenError, SyntaxError, ValueError, TypeError, ArithmeticError, RecursionError):
        shown = text if len(text) < 60 else f'{text[:57]}…'
        return Unknown(f'Python expression {shown!r} that could not be computed')


def _value(node: ast.expr) -> Any:
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name) and node.id in _WORDS:
        return _WORDS[node.id]
    if isinstance(node, (ast.List, ast.Tuple)):
        return [_value(each) for each in node.elts]
    if isinstance(node, ast.BoolOp):
        return _logic(node)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return not _value(node.operand)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        return -_value(node.operand)
    if isinstance(node, ast.IfExp):
        return _value(node.body if _value(node.test) else node.orelse)
    if isinstance(node, ast.BinOp) and type(node.op) in _BINARY:
        return _BINARY[type(node.op)](_value(node.left), _value(node.right))
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in _COMPARE:
        return _COMPARE[type(node.ops[0])](_value(node.left), _value(node.comparators[0]))
    if isinstance(node, ast.Call) and not node.keywords and len(node.args) == 1:
        return _call(node)
    raise _OpenError


def _logic(node: ast.BoolOp) -> Any:
    found: Any = None
    for part in node.values:
        found = _value(part)
        if bool(found) is not isinstance(node.op, ast.And):
            break
    return found


def _call(node: ast.Call) -> Any:
    name = node.func.id if isinstance(node.func, ast.Name) else ''
    if name not in _CALLS:
        raise _OpenError
    return _CALLS[name](_value(node.args[0]))
