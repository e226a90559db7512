"""Which functions and classes a text leads to, by the names that stand in it, and what they do."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import partial

from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World

_DOING = frozenset(
    {
        'Thread',
        'Timer',
        'Process',
        'ThreadPoolExecutor',
        'ProcessPoolExecutor',
        'submit',
        'Lock',
        'RLock',
        'Event',
        'Condition',
        'Semaphore',
        'Barrier',
        'acquire',
        'wait',
        'exec',
        'eval',
        'getattr',
        'exit',
    }
)


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


def leads_nowhere(machine: Machine, start: ast.AST) -> bool:
    """Whether nothing that ``start`` names does more than to compute something."""
    does_more = partial(_does_more, _DOING | machine.model.acting)
    return not any(
        noted_on(node, 'does_more', does_more) for node in reachable(machine.world, start)
    )


def _does_more(acting: frozenset[str], node: ast.AST) -> bool:
    """Whether it names threads, locks and waits, or calls what is passed in."""
    if not acting.isdisjoint(used_names(node)):
        return True
    handed_in = {part.arg for part in walk(node) if isinstance(part, ast.arg)} - {'cls'}
    return any(
        isinstance(part, ast.Call)
        and isinstance(part.func, ast.Name)
        and part.func.id in handed_in
        for part in walk(node)
    )
