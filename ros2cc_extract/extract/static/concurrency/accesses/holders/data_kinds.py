"""What kind of thing an attribute holds: a lock, nothing, an empty collection."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.program.text_queries import (
    cleared_attributes,
    reassigned_attributes,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Const,
    Instance,
    Value,
    options_of,
)

LOCKS = frozenset({'lock', 'rlock', 'condition', 'semaphore'})


def is_emptied(kind: AccessKind, stored: Value | None) -> bool:
    """``self.rows = []``: nothing of what was in it is left."""
    if kind is not AccessKind.WRITE or not isinstance(stored, Collection):
        return False
    return not any(stored.slots.get(name) for name in ('items', 'entries', 'open'))


def is_false(stored: Value | None) -> bool:
    """Whether a constant is false."""
    return isinstance(stored, Const) and not stored.value


def holds_lock(owner: Instance) -> bool:
    """Whether an object of the program has a lock of its own."""
    return owner.state is None and any(
        isinstance(option, Instance)
        and isinstance(option.state, PlainState)
        and option.state.kind in LOCKS
        for held in owner.slots.values()
        if isinstance(held, Value)
        for option in options_of(held)
    )


def is_assigned(cls: Value | None, name: str) -> bool:
    """Whether a method assigns the attribute that was not made yet."""
    return any(name in reassigned_attributes(base.node) for base in _classes(cls))


def is_taken_away(owner: Value, name: str) -> bool:
    """Whether a method stores ``None`` where an entity, a lock or a function may be."""
    cls = owner.cls if isinstance(owner, Instance) else owner
    return any(name in cleared_attributes(base.node) for base in _classes(cls))


def _classes(cls: Value | None) -> Iterator[Class]:
    return (base for base in getattr(cls, 'mro', ()) if isinstance(base, Class))
