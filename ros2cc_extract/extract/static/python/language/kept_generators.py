"""
Generator expressions and ``map`` that are kept: they run where items are taken from them.

``self.steps = (self.go(leg) for leg in legs)`` goes nowhere yet; what takes its items does. It is
a generator function without a name. One that calls nothing is the collection of its items.
"""

from __future__ import annotations

import ast
from typing import TypeVar

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Generator
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Function,
    Native,
    Partial,
    Value,
)

Made = TypeVar('Made', bound=ast.AST)

_FIRST = '.0'
_APPLIED = ('map', 'filter')


def kept(machine: Machine, node: ast.expr, frame: Frame) -> Value | None:
    """The generator that ``node`` makes, if it makes one that calls something."""
    while isinstance(node, ast.Call) and _name_of(node) == 'iter' and len(node.args) == 1:
        node = node.args[0]
    if isinstance(node, ast.Call) and _applies(machine, node, frame):
        node = noted_on(node, 'as_generator', _as_generator)
    if not isinstance(node, ast.GeneratorExp) or not noted_on(node, 'calls', _calls):
        return None
    first = machine.evaluate(node.generators[0].iter, frame)
    function = machine.make_function(noted_on(node, 'as_function', _as_function), frame)
    place = frame.place(node)
    return Generator(function, Call(place, [first])) if isinstance(function, Function) else None


def _name_of(call: ast.Call) -> str:
    return call.func.id if isinstance(call.func, ast.Name) else ''


def _calls(node: ast.GeneratorExp) -> bool:
    items = node.generators[0].iter
    parts = [node.elt, *(test for each in node.generators for test in each.ifs)]
    if isinstance(items, ast.Call) and isinstance(items.func, ast.Attribute):
        return True
    return any(isinstance(part, ast.Call) for each in parts for part in walk(each))


def _applies(machine: Machine, node: ast.Call, frame: Frame) -> bool:
    """Whether it is ``map`` or ``filter`` of a function of the program."""
    name, given = _name_of(node), node.args
    is_plain = not node.keywords and not any(isinstance(each, ast.Starred) for each in given)
    if name not in _APPLIED or not is_plain or len(given) != len(_APPLIED):
        return False
    called = machine.evaluate(node.func, frame)
    is_own = isinstance(machine.evaluate(given[0], frame), (Function, Bound, Partial))
    return isinstance(called, Native) and called.name == f'builtins.{name}' and is_own


def _as_generator(node: ast.Call) -> ast.GeneratorExp:
    function, items = node.args
    item = ast.Name('.item', ast.Load())
    applied = ast.Call(function, [item], [])
    is_map = _name_of(node) == 'map'
    over = ast.comprehension(
        ast.Name('.item', ast.Store()), items, [] if is_map else [applied], is_async=0
    )
    return _placed(ast.GeneratorExp(applied if is_map else item, [over]), node)


def _as_function(node: ast.GeneratorExp) -> ast.FunctionDef:
    body: list[ast.stmt] = [ast.Expr(ast.Yield(node.elt))]
    for number, each in reversed(list(enumerate(node.generators))):
        for test in reversed(each.ifs):
            body = [ast.If(test, body, [])]
        items = each.iter if number else ast.Name(_FIRST, ast.Load())
        body = [ast.For(each.target, items, body, [])]
    arguments = ast.arguments([], [ast.arg(_FIRST)], None, [], [], None, [])
    return _placed(ast.FunctionDef('<genexpr>', arguments, body, []), node)


def _placed(made: Made, at: ast.expr) -> Made:
    """``made`` with the places of what it is made of; what is new stands at ``at``."""
    waiting: list[ast.AST] = [made]
    while waiting:
        part = waiting.pop()
        if not hasattr(part, 'lineno'):
            if 'lineno' in part._attributes:
                ast.copy_location(part, at)
            waiting.extend(ast.iter_child_nodes(part))
    return made
