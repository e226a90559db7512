"""
Flags that are put up right behind the test that has found them down.

``if self.done: return``, then ``self.done = True``: CPython, with its global lock, lets no other
thread in between, because nothing is called and no loop jumps back (see ``atomic_updates.py``).
So only one run gets past the test. What others find there is decided by the reader of the
accesses, who knows all that write the flag.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.concurrency.accesses.flags.flag_locks import (
    flags_asked,
    is_left,
)
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.frame import Frame

_Position = tuple[int, int]
_QUIET = (
    ast.BoolOp,
    ast.boolop,
    ast.UnaryOp,
    ast.Not,
    ast.Compare,
    ast.Is,
    ast.IsNot,
    ast.Name,
    ast.Attribute,
    ast.Constant,
    ast.expr_context,
)
"""What a test may be made of: neither a call, nor a comparison that may be one."""


def is_claim(node: ast.Assign | ast.AugAssign, frame: Frame) -> bool:
    """Whether the statement puts up what the test right before it has found down."""
    if frame.function is None:
        return False
    claims = noted_on(frame.function.node, 'claims', _claims)
    return (node.lineno, node.col_offset) in claims


def is_at_once(world: ConcurrentWorld, name: str) -> bool:
    """Whether that statement is followed now, and no other code, as of a property, came before."""
    return world.reading.is_claim and not world.reading.has_called_since(name, world.path)


def _claims(function: ast.AST) -> frozenset[_Position]:
    return frozenset(
        position
        for part in walk(function)
        for block in _blocks(part)
        for position in _claims_of(block)
    )


def _blocks(part: ast.AST) -> Iterator[Sequence[ast.stmt]]:
    """The lists of statements that stand directly in a statement."""
    for name in ('body', 'orelse', 'finalbody'):
        block = getattr(part, name, None)
        if isinstance(block, list):
            yield block


def _claims_of(block: Sequence[ast.stmt]) -> Iterator[_Position]:
    for index, test in enumerate(block):
        if not isinstance(test, ast.If) or not _is_quiet(test.test):
            continue
        yield from _put_up(test.body, test.test, when=True)
        yield from _put_up(test.orelse, test.test, when=False)
        if is_left(test):
            yield from _put_up(block[index + 1 :], test.test, when=False)


def _put_up(block: Sequence[ast.stmt], test: ast.expr, *, when: bool) -> Iterator[_Position]:
    """The statements at the begin of ``block`` that store a constant in a flag of the test."""
    names = {name for name, down_if, _ in flags_asked(test, _no_constant) if down_if is when}
    asked = {ast.unparse(part) for part in walk(test) if _is_place(part)}
    for node in block:
        if isinstance(node, ast.Assign) and _stores_constant(node):
            target = node.targets[0]
            name = target.attr if isinstance(target, ast.Attribute) else ast.unparse(target)
            if name in names and ast.unparse(target) in asked:
                yield node.lineno, node.col_offset
        elif not _is_passed(node):
            return


def _no_constant(_value: ast.expr) -> str | None:
    """States are left out: whether two of them are equal may be decided by any code."""
    return None


def _is_passed(node: ast.stmt) -> bool:
    """A further test without a call on the way, or what does nothing."""
    if isinstance(node, ast.If):
        return is_left(node) and _is_quiet(node.test)
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    return is_text or isinstance(node, (ast.Global, ast.Nonlocal, ast.Pass))


def _stores_constant(node: ast.Assign) -> bool:
    is_one = len(node.targets) == 1 and _is_place(node.targets[0])
    return is_one and isinstance(node.value, ast.Constant)


def _is_quiet(test: ast.expr) -> bool:
    return all(
        isinstance(part, _QUIET) and (not isinstance(part, ast.Attribute) or _is_place(part))
        for part in ast.walk(test)
    )


def _is_place(part: ast.AST) -> bool:
    """A name, or an attribute of one."""
    if isinstance(part, ast.Attribute):
        return isinstance(part.value, ast.Name)
    return isinstance(part, ast.Name)
