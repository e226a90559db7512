"""Which functions and classes a text leads to, by the names that stand in it."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.world import World


def reachable(world: World, start: ast.AST) -> Iterator[ast.AST]:
    """``start``, and the functions and classes that it leads to by name."""
    indices = [noted_on(tree, 'by_name', _by_name) for tree in world.trees]
    waiting, seen = [start], {id(start)}
    while waiting:
        node = waiting.pop()
        yield node
        for name in noted_on(node, 'used_names', used_names):
            for index in indices:
                for other in index.get(name, ()):
                    if id(other) not in seen:
                        seen.add(id(other))
                        waiting.append(other)


def used_names(node: ast.AST) -> frozenset[str]:
    """The names and attributes that stand in it."""
    return frozenset(name for part in walk(node) if (name := _name(part)) is not None)


def _name(part: ast.AST) -> str | None:
    if isinstance(part, ast.Name):
        return part.id
    return part.attr if isinstance(part, ast.Attribute) else None


def _by_name(tree: ast.Module) -> dict[str, list[ast.AST]]:
    """The functions and classes of a module, also those without a name of their own."""
    found: dict[str, list[ast.AST]] = {}
    for part in walk(tree):
        if isinstance(part, (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)):
            found.setdefault(part.name, []).append(part)
        elif isinstance(part, ast.Assign) and isinstance(part.value, ast.Lambda):
            for name in filter(None, map(_name, part.targets)):
                found.setdefault(name, []).append(part.value)
    return found
