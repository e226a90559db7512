"""
Collections under several names: each is known by the attribute that held it first.

A dictionary that is handed to a helper or to a thread is one object under two names, and what
changes it under the one is seen under the other.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import noted_on, reassigned_attributes
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Function,
    Instance,
    Value,
    options_of,
)

Home = tuple[Value, str]
_FIXED = ('tuple', 'frozenset')


def note_held(
    world: ConcurrentWorld, owner: Value, attribute: str, value: Value, shown: str
) -> None:
    """``owner`` holds ``value`` from here on; ``shown`` names the attribute."""
    if not isinstance(value, Collection) or getattr(value, 'kind', '') in _FIXED:
        return
    if isinstance(owner, Instance) and is_reassigned(owner, attribute):
        world.lent.setdefault(value, (owner, attribute, shown))
    elif isinstance(owner, Instance):
        world.homes.setdefault(value, (owner, shown))


def home_of(world: ConcurrentWorld, owner: Value, attribute: str) -> Home | None:
    """The first holder of the collection that an attribute holds for good, and its name."""
    if not isinstance(owner, Instance) or not (world.homes or world.lent):
        return None
    held = owner.slots.get(attribute)
    if not isinstance(held, Collection) or is_reassigned(owner, attribute):
        return None
    return next(iter(lenders_of(world, held)), None) or world.homes.get(held)


def homes_of(world: ConcurrentWorld, value: Value) -> list[Home]:
    """The same of the collections that a local variable may hold."""
    known = (world.homes.get(v) for v in options_of(value) if isinstance(v, Collection))
    return [home for home in known if home is not None]


def lenders_of(world: ConcurrentWorld, value: Value) -> list[Home]:
    """
    The attributes that may still hold what a local variable holds, though others are stored there.

    What has been replaced since (``rows, self.rows = self.rows, []``) is shared no longer.
    """
    lent = {v: world.lent[v] for v in options_of(value) if v in world.lent}
    return [
        (owner, shown)
        for collection, (owner, attribute, shown) in lent.items()
        if isinstance(held := owner.slots.get(attribute), Value)  # type: ignore[attr-defined]
        and any(option is collection for option in options_of(held))
    ]


def object_name(owner: Instance | Class, cls: Class) -> str:
    """The class; helper objects of one class get numbers, nodes are distinguished by callbacks."""
    is_helper = isinstance(owner, Instance) and owner.state is None and owner.number > 1
    return f'{cls.name}#{owner.number}' if is_helper else cls.name  # type: ignore[union-attr]


def is_reassigned(owner: Instance, attribute: str) -> bool:
    """Whether a method stores another one there: then the names part at an unknown time."""
    return any(
        isinstance(cls, Class) and attribute in reassigned_attributes(cls.node)
        for cls in owner.mro
    )


def is_property(owner: Value, name: str) -> bool:
    """Whether code of the class gives the attribute."""
    if not isinstance(owner, Instance) or name in owner.slots:
        return False
    classes = (cls for cls in owner.mro if isinstance(cls, Class) and name in cls.slots)
    held = next((cls.slots[name] for cls in classes), None)
    return isinstance(held, Function) and held.binding == 'property'


def is_getter(function: Function) -> bool:
    """Whether it only gives what an attribute holds, perhaps under a lock."""
    return noted_on(function.node, 'is_getter', _only_gives)


def _only_gives(node: ast.AST) -> bool:
    body = node.body if isinstance(node, (ast.FunctionDef, ast.With)) else []
    stated = [each for each in body if not _is_text(each)]
    if len(stated) != 1:
        return False
    (only,) = stated
    if isinstance(only, ast.Return):
        return isinstance(only.value, ast.Attribute)
    return isinstance(only, ast.With) and _only_gives(only)


def _is_text(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
