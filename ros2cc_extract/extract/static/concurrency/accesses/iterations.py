"""What code goes over: in a loop, by its indices, or all at once (``list(self.rows)``)."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.python.values.values import Library, Native, Value

_VIEWS = frozenset({'items', 'keys', 'values'})
_PASSING_ON = frozenset({'enumerate', 'zip', 'reversed', 'iter', 'map', 'filter'})
_TAKING_ALL = frozenset(
    f'builtins.{name}'
    for name in ('list', 'tuple', 'set', 'frozenset', 'dict', 'sorted', 'sum', 'min', 'max')
)
_STEPS = frozenset({'send', '__next__'})
_COPIES, _JOINS = 'copy', 'str.join'


def iterated(node: ast.expr) -> Iterator[ast.expr]:
    """What a loop over ``node`` goes over, by the names it is known under."""
    if isinstance(node, (ast.Attribute, ast.Name)):
        yield node
    elif isinstance(node, ast.Call):
        function = node.func
        if isinstance(function, ast.Attribute) and function.attr in _VIEWS:
            yield from iterated(function.value)
        elif isinstance(function, ast.Name) and function.id in _PASSING_ON:
            for argument in node.args:
                yield from iterated(argument)
        else:
            yield node


def taken_at_once(function: Value, node: ast.Call) -> ast.expr | None:
    """The collection of which a call takes all items at once."""
    if not isinstance(function, Native):
        return None
    if function.name == _COPIES and isinstance(node.func, ast.Attribute):
        return node.func.value
    is_taken = function.name in _TAKING_ALL or function.name == _JOINS
    return node.args[0] if is_taken and node.args else None


def stepped(function: Value, node: ast.Call) -> ast.expr | None:
    """The iterator that a call asks for its next item."""
    name = function.name if isinstance(function, (Native, Library)) else ''
    if name == 'builtins.next':
        return node.args[0] if node.args else None
    is_sent = name in _STEPS and isinstance(node.func, ast.Attribute)
    return node.func.value if is_sent else None  # type: ignore[attr-defined]


def by_index(loop: ast.For) -> ast.expr | None:
    """``for i in range(len(rows))``: the list of which an item is asked for by that index."""
    call, index = loop.iter, loop.target
    if not (isinstance(call, ast.Call) and isinstance(index, ast.Name) and len(call.args) == 1):
        return None
    counted = call.args[0]
    if ast.unparse(call.func) != 'range' or not isinstance(counted, ast.Call):
        return None
    if ast.unparse(counted.func) != 'len' or len(counted.args) != 1:
        return None
    rows = ast.unparse(counted.args[0])
    asked = (
        part
        for statement in loop.body
        for part in ast.walk(statement)
        if isinstance(part, ast.Subscript) and isinstance(part.slice, ast.Name)
    )
    item = f'{rows}[{index.id}]'
    return counted.args[0] if item in map(ast.unparse, asked) else None
