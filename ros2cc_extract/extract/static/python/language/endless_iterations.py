"""``for _ in itertools.count():`` is ``while True:``, with a name that grows in each round."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.program.text_queries import noted_on
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Library

_ENDLESS = {'itertools.count': 2, 'itertools.repeat': 1}
"""What gives items forever, with at most so many arguments."""


def as_while(machine: Machine, node: ast.For | ast.AsyncFor, frame: Frame) -> ast.While | None:
    """The ``while`` loop that does the same, where a ``for`` loop goes over such items."""
    items = node.iter
    if not isinstance(items, ast.Call) or not isinstance(node.target, ast.Name):
        return None
    if not isinstance(node, ast.For):
        return None
    if not isinstance(items.func, (ast.Name, ast.Attribute)) or items.keywords:
        return None
    name = items.func.id if isinstance(items.func, ast.Name) else items.func.attr
    if not any(name == known.rpartition('.')[2] for known in _ENDLESS):
        return None
    called = machine.evaluate(items.func, frame)
    if not isinstance(called, Library) or len(items.args) > _ENDLESS.get(called.name, -1):
        return None
    loop = noted_on(node, 'as_while', _made)
    machine.assign(node.target, machine.mystery('a counter', frame.place(node.iter)), frame)
    return loop


def _made(node: ast.For) -> ast.While:
    assert isinstance(node.target, ast.Name)
    grows = ast.AugAssign(node.target, ast.Add(), ast.Constant(1))
    loop = ast.While(ast.Constant(True), [grows, *node.body], node.orelse)
    ast.copy_location(loop, node)
    for part in (loop.test, grows, grows.value):
        ast.copy_location(part, node.iter)
    return loop
