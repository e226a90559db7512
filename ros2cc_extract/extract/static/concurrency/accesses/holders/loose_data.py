"""
Data that hangs on no object of a scanned class.

Variables of other modules, attributes of functions, default values and results that are kept, and
the fields of a message or of another object that is not scanned and that an attribute holds.
"""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import CHANGING_METHODS, noted_on, walk
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Class,
    Function,
    Instance,
    Library,
    Module,
    Mystery,
    Native,
    Scope,
    Value,
    options_of,
)

_CODE = (Bound, Class, Function, Library, Module, Native)
_OF_EACH_THREAD = frozenset({'threading.local(…)', 'contextvars.ContextVar(…)'})
_FIXED = ('tuple', 'frozenset')


def shown(world: ConcurrentWorld, owner: Value, name: str, *, is_read: bool) -> str | None:
    """What ``owner.name`` is called; ``None`` where it is no data that others see or change."""
    if is_read and not any(name in noted_on(t, 'changed', _changed) for t in world.trees):
        return None
    if isinstance(owner, Module):
        return f'{owner.name}.{name}' if _is_data(owner.slots.get(name)) else None
    if isinstance(owner, Function):
        is_own = is_own_function(owner) or name.startswith('__')
        return None if is_own or not _is_data(owner.slots.get(name)) else _of(owner, name)
    whole = world.objects.get(owner) or world.members.get(owner)
    if isinstance(owner, Mystery) and whole is not None and owner.text not in _OF_EACH_THREAD:
        return f'{whole}.{name}'
    return None


def _changed(tree: ast.AST) -> frozenset[str]:
    """The attributes that a text stores, or changes in place."""
    return frozenset(part.attr for part in map(_target, walk(tree)) if part is not None)


def _target(part: ast.AST) -> ast.Attribute | None:
    if isinstance(part, ast.Call) and isinstance(part.func, ast.Attribute):
        whole = part.func.value if part.func.attr in CHANGING_METHODS else None
        return whole if isinstance(whole, ast.Attribute) else None
    if isinstance(getattr(part, 'ctx', None), ast.Load):
        return None
    while isinstance(part, ast.Subscript):
        part = part.value
    return part if isinstance(part, ast.Attribute) else None


def note_held(world: ConcurrentWorld, owner: Function | Module, name: str, value: Value) -> None:
    """A collection, or an object that is not scanned, is known by what holds it first."""
    if isinstance(owner, Function) and is_own_function(owner):
        return
    called = f'{owner.name}.{name}' if isinstance(owner, Module) else _of(owner, name)
    if isinstance(value, Collection) and getattr(value, 'kind', '') not in _FIXED:
        world.homes.setdefault(value, (owner, called))
    elif isinstance(value, Mystery):
        world.objects.setdefault(value, called)


def note_member(world: ConcurrentWorld, owner: Value, name: str, value: Value) -> None:
    """A field of an object that is not scanned is a part of it."""
    whole = world.objects.get(owner) or world.members.get(owner)
    if whole is not None and isinstance(value, Mystery):
        world.members.setdefault(value, f'{whole}.{name}')


def home_of_local(world: ConcurrentWorld, scope: Scope, name: str) -> str | None:
    """What a local name stands for, where no attribute of an object holds that."""
    held = scope.slots.get(name)
    home = world.homes.get(held) if isinstance(held, Collection) else None
    return None if home is None or isinstance(home[0], Instance) else home[1]


def is_own_function(function: Function) -> bool:
    """Whether a run of a callback has defined it, for itself."""
    return function.scope is not None and function.scope.born is not None


def _of(function: Function, name: str) -> str:
    return f'{function.full_name}.{name}'


def _is_data(held: object) -> bool:
    options = [o for o in options_of(held) if o != NONE] if isinstance(held, Value) else []
    return not options or not all(
        isinstance(option, _CODE) or (isinstance(option, Instance) and option.state is not None)
        for option in options
    )
