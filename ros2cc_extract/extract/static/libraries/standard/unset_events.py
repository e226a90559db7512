"""Events that are never set: their ``is_set`` gives ``False`` forever."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk
from ros2cc_extract.extract.static.python.values.values import Instance

_HARMLESS = frozenset({'is_set', 'isSet', 'clear', 'wait'})


def is_never_set(world: ConcurrentWorld, event: Instance) -> bool:
    """
    Whether its name stands nowhere in the program but where it is asked, waited for or cleared.

    Then no code has it by another name either. Code that sets it may use its name in a text, too.
    """
    name = event.hint
    if name is None or not world.is_program or event.born is not None:
        return False
    return not any(name in noted_on(tree, 'handed_on', _handed_on) for tree in world.trees)


def _handed_on(tree: ast.Module) -> frozenset[str]:
    """The names that stand where a value of them may go elsewhere, or be changed."""
    uses = Counter(name for part in walk(tree) for name in _read(part))
    harmless = Counter(
        name
        for part in walk(tree)
        if isinstance(part, ast.Attribute) and part.attr in _HARMLESS
        for name in _read(part.value)
    )
    texts = {
        part.value
        for part in walk(tree)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
    }
    other_names = {name for part in walk(tree) for name in _given_two_names(part)}
    return frozenset(name for name in uses if uses[name] > harmless[name]) | texts | other_names


def _given_two_names(part: ast.AST) -> Iterator[str]:
    """The names in ``a = b = Event()``, and in ``a = (b := Event())``."""
    targets = part.targets if isinstance(part, ast.Assign) and len(part.targets) > 1 else []
    for target in (*targets, *([part.target] if isinstance(part, ast.NamedExpr) else [])):
        if isinstance(target, ast.Attribute):
            yield target.attr
        elif isinstance(target, ast.Name):
            yield target.id


def _read(part: ast.AST) -> Iterator[str]:
    if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load):
        yield part.id
    elif isinstance(part, ast.Attribute) and isinstance(part.ctx, ast.Load):
        yield part.attr
