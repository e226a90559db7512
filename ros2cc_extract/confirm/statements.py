"""Which lines a place stands for, and the values that a program compares with."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from ros2cc_extract.files import read_regular

_MOST_BYTES = 5_000_000
_MOST_VALUES = 12
_HEADED = (
    ast.If,
    ast.For,
    ast.AsyncFor,
    ast.With,
    ast.AsyncWith,
    ast.FunctionDef,
    ast.AsyncFunctionDef,
)


def tree_of(path: Path) -> ast.Module:
    """Read a source; one that cannot be read has no statements."""
    try:
        return ast.parse(read_regular(path, _MOST_BYTES))
    except (OSError, SyntaxError, ValueError, RecursionError):
        return ast.Module(body=[], type_ignores=[])


def lines_of(tree: ast.Module, line: int) -> tuple[int, int]:
    """
    Give first and last line of the innermost statement at a line.

    Of a loop that asks again and again it is the whole loop, of other statements with a body only
    their head.
    """
    best: ast.stmt | None = None
    for node in ast.walk(tree):
        is_at = isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or 0)
        if is_at and isinstance(node, ast.stmt) and (best is None or node.lineno >= best.lineno):
            best = node
    if best is None:
        return line, line
    if isinstance(best, _HEADED):
        return best.lineno, max(best.lineno, best.body[0].lineno - 1)
    return best.lineno, best.end_lineno or best.lineno


def loop_future(tree: ast.Module, line: int) -> str | None:
    """Name what a loop asks whether it is done, as in ``while not future.done():``."""
    for node in ast.walk(tree):
        if isinstance(node, ast.While) and node.lineno <= line <= (node.end_lineno or 0):
            for call in ast.walk(node):
                if (
                    isinstance(call, ast.Call)
                    and isinstance(call.func, ast.Attribute)
                    and call.func.attr == 'done'
                ):
                    return ast.unparse(call.func.value)
    return None


def values_compared(tree: ast.Module) -> list[str | int | float]:
    """Give the texts and numbers that comparisons name, in their order."""
    found: list[str | int | float] = []
    for value in _constants(tree):
        if value not in found and len(found) < _MOST_VALUES:
            found.append(value)
    return found


def _constants(tree: ast.Module) -> Iterator[str | int | float]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Compare) and ast.unparse(node.left) != '__name__':
            for each in (node.left, *node.comparators):
                for part in ast.walk(each):
                    if isinstance(part, ast.Constant) and type(part.value) in (str, int, float):
                        yield part.value  # type: ignore[misc]
                        if isinstance(part.value, (int, float)):
                            yield part.value + 1
        elif isinstance(node, ast.MatchValue) and isinstance(node.value, ast.Constant):
            yield from [node.value.value] if isinstance(node.value.value, (str, int)) else []
