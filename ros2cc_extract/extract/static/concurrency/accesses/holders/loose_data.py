"""
Data that hangs on no object of a scanned class.

Variables of other modules, attributes of functions, default values and results that are kept, and
the fields of a message or of another object that is not scanned and that an attribute holds.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
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
_FIXED = ('tuple', 'frozenset')


def shown(world: ConcurrentWorld, owner: Value, name: str) -> str | None:
    """What ``owner.name`` is called; ``None`` where it is no data that others see."""
    if isinstance(owner, Module):
        return f'{owner.name}.{name}' if _is_data(owner.slots.get(name)) else None
    if isinstance(owner, Function):
        is_own = is_own_function(owner) or name.startswith('__')
        return None if is_own or not _is_data(owner.slots.get(name)) else _of(owner, name)
    if isinstance(owner, Mystery) and owner in world.objects:
        return f'{world.objects[owner]}.{name}'
    return None


def note_held(world: ConcurrentWorld, owner: Function | Module, name: str, value: Value) -> None:
    """A collection, or an object that is not scanned, is known by what holds it first."""
    if isinstance(owner, Function) and is_own_function(owner):
        return
    called = f'{owner.name}.{name}' if isinstance(owner, Module) else _of(owner, name)
    if isinstance(value, Collection) and getattr(value, 'kind', '') not in _FIXED:
        world.homes.setdefault(value, (owner, called))
    elif isinstance(value, Mystery):
        world.objects.setdefault(value, called)


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
