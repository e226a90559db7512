"""
Tests of loops, with what local copies are taken of in place of the copies.

``while (pose := self.pose) is None`` asks for ``self.pose``, and so does ``while True`` with
``pose = self.pose`` and ``if pose is not None: break`` in it.
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any

from ros2cc_extract.extract.static.concurrency.waits.loops.loop_tests import own_parts
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk

Copies = dict[str, ast.expr]


def copies_in(loop: ast.While) -> Copies:
    """The names that each round of ``loop`` gives a value once, and the values."""
    return noted_on(loop, 'copies_in', _copies_in)


def _copies_in(loop: ast.While) -> Copies:
    parts = [*walk(loop.test), *own_parts(loop.body)]
    stored = Counter(
        part.id for part in parts if isinstance(part, ast.Name) and not _is_loaded(part)
    )
    return {
        name: value
        for part in parts
        for name, value in _given(part)
        if stored[name] == 1 and name not in _names(value) and not _is_left_open(value)
    }


def _given(part: ast.AST) -> Iterator[tuple[str, ast.expr]]:
    """The name that gets a value here, and the value."""
    if isinstance(part, ast.Assign) and len(part.targets) == 1:
        target = part.targets[0]
    elif isinstance(part, (ast.AnnAssign, ast.NamedExpr)):
        target = part.target
    else:
        return
    if isinstance(target, ast.Name) and part.value is not None:
        yield target.id, part.value


def _is_left_open(value: ast.expr) -> bool:
    """Whether others run before the value is there."""
    return any(isinstance(part, (ast.Await, ast.Yield, ast.YieldFrom)) for part in walk(value))


def _is_loaded(name: ast.Name) -> bool:
    return isinstance(name.ctx, ast.Load)


def _names(value: ast.expr) -> set[str]:
    return {part.id for part in walk(value) if isinstance(part, ast.Name)}


def without_copies(
    test: ast.expr, copies: Copies, only_looks: Callable[[ast.expr], bool]
) -> ast.expr:
    """
    ``test``, in which the values stand for the names of ``copies``.

    :param only_looks: whether a value may be computed once more, as nothing changes by it.
    """
    if not copies or _names(test).isdisjoint(copies):
        return test
    known = {name: value for name, value in copies.items() if only_looks(value)}
    shown: ast.expr = ast.copy_location(_shown(test, known), test)
    return shown


def _shown(node: Any, copies: Copies) -> Any:
    """A copy, without what is noted on nodes; what stands in a value leads no way back."""
    if isinstance(node, list):
        return [_shown(each, copies) for each in node]
    if not isinstance(node, ast.AST):
        return node
    if isinstance(node, ast.NamedExpr):
        return _shown(node.value if node.target.id in copies else node.target, copies)
    if isinstance(node, ast.Name) and _is_loaded(node) and node.id in copies:
        others = {name: value for name, value in copies.items() if name != node.id}
        return _shown(copies[node.id], others)
    fields = {name: _shown(value, copies) for name, value in ast.iter_fields(node)}
    return ast.copy_location(type(node)(**fields), node)
