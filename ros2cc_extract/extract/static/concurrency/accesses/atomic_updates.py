"""
Updates in which CPython lets no other thread in between the read and the write.

With its global lock CPython 3.10 and later switches threads where a function of Python begins, at
a call and where a loop jumps back (``ceval.c``, the "eval breaker"). Measured on 3.10, 3.11, 3.12
and 3.13, two threads with a switch interval of 1 µs: of 4 to 20 million ``self.n += 1`` and
``self.n = self.n + 1`` none was lost, of those with a property, an ``__add__`` of Python or a call
in between 27 to 45 %. The language promises none of that, and builds without the lock lose some.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.python.machine.dependences import computed_from
from ros2cc_extract.extract.static.python.machine.frame import Frame
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Const,
    Instance,
    is_number_or_text,
    options_of,
)


@contextmanager
def noted(
    machine: ConcurrentMachine, node: ast.AugAssign | ast.Assign, frame: Frame
) -> Iterator[None]:
    """While the statement is followed, its write is known to be in one piece, if it is."""
    reading = machine.world.reading
    if machine.world.effects is None:
        yield
        return
    reading.is_whole = _is_whole(machine, node, frame)
    try:
        yield
    finally:
        reading.is_whole = False


def _is_whole(machine: ConcurrentMachine, node: ast.AugAssign | ast.Assign, frame: Frame) -> bool:
    if isinstance(node, ast.AugAssign):
        parts: list[ast.expr] = [_as_read(node.target), node.value]
    else:
        parts = [node.value]
    if not all(_is_quiet(part) for part in parts):
        return False
    if isinstance(node, ast.Assign) and not machine.world.reading.flowing:
        return False  # nothing that others write is read for it
    if computed_from(node.value, frame.sources):
        return False  # a copy of shared data that was read before
    effects, machine.world.effects = machine.world.effects, None
    try:
        with machine.world.reading.apart():
            leaves = [leaf for part in parts for leaf in _leaves(part)]
            return all(_is_plain(machine, leaf, frame) for leaf in leaves)
    finally:
        machine.world.effects = effects


def _as_read(target: ast.expr) -> ast.expr:
    if isinstance(target, ast.Attribute):
        read: ast.expr = ast.Attribute(target.value, target.attr, ast.Load())
    elif isinstance(target, ast.Subscript):
        read = ast.Subscript(target.value, target.slice, ast.Load())
    else:
        assert isinstance(target, ast.Name)
        read = ast.Name(target.id, ast.Load())
    return ast.copy_location(read, target)


def _is_quiet(value: ast.expr) -> bool:
    """Nothing in it is a call, nor code of a kind that may be one."""
    return all(isinstance(part, _QUIET) for part in ast.walk(value))


_QUIET = (
    ast.Constant,
    ast.Name,
    ast.Attribute,
    ast.Subscript,
    ast.BinOp,
    ast.UnaryOp,
    ast.operator,
    ast.unaryop,
    ast.expr_context,
)


def _leaves(value: ast.expr) -> Iterator[ast.expr]:
    """What is read in it, item by item."""
    if isinstance(value, ast.BinOp):
        yield from _leaves(value.left)
        yield from _leaves(value.right)
    elif isinstance(value, ast.UnaryOp):
        yield from _leaves(value.operand)
    else:
        yield value


def _is_plain(machine: ConcurrentMachine, leaf: ast.expr, frame: Frame) -> bool:
    """Whether it is a number or a text, and no code of Python gives it."""
    if isinstance(leaf, ast.Attribute):
        if not _is_quiet_path(machine, leaf, frame):
            return False
    elif isinstance(leaf, ast.Subscript):
        holder = leaf.value
        if isinstance(holder, ast.Attribute):
            if not _is_quiet_path(machine, holder, frame):
                return False
        elif not isinstance(holder, ast.Name):
            return False
        is_constant = isinstance(leaf.slice, (ast.Constant, ast.Name))
        is_known = is_constant and is_number_or_text(machine.evaluate(leaf.slice, frame))
        if not is_known or not isinstance(machine.evaluate(holder, frame), Collection):
            return False
    elif not isinstance(leaf, (ast.Constant, ast.Name)):
        return False
    return is_number_or_text(machine.evaluate(leaf, frame))


def _is_quiet_path(machine: ConcurrentMachine, node: ast.expr, frame: Frame) -> bool:
    """A name, with attributes that no code of Python gives."""
    if isinstance(node, ast.Attribute):
        return _is_quiet_path(machine, node.value, frame) and _has(machine, node, frame)
    return isinstance(node, ast.Name)


def _has(machine: ConcurrentMachine, node: ast.Attribute, frame: Frame) -> bool:
    """Whether the object has the attribute itself, or a constant of its class, no property."""
    owners = options_of(machine.evaluate(node.value, frame))
    name = frame.attribute_name(node.attr)
    return bool(owners) and all(
        isinstance(owner, Instance) and (name in owner.slots or _is_of_class(owner, name))
        for owner in owners
    )


def _is_of_class(owner: Instance, name: str) -> bool:
    classes = (cls for cls in owner.mro if isinstance(cls, Class) and name in cls.slots)
    first = next(classes, None)
    return first is not None and isinstance(first.slots[name], Const)
