"""What kind of thing an attribute holds: a lock, nothing, an empty collection."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.program.text_queries import (
    reassigned_attributes,
    replaced_attributes,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.world import AccessKind, World
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.enumerations import Member
from ros2cc_extract.extract.static.python.values.values import (
    Class,
    Const,
    Instance,
    Value,
    options_of,
)

_CATCHING = frozenset({'AttributeError', 'Exception', 'BaseException', ''})
LOCKS = frozenset({'lock', 'rlock', 'condition', 'semaphore'})


def is_emptied(kind: AccessKind, stored: Value | None) -> bool:
    """``self.rows = []``: nothing of what was in it is left."""
    if kind is not AccessKind.WRITE or not isinstance(stored, Collection):
        return False
    return not any(stored.slots.get(name) for name in ('items', 'entries', 'open'))


def is_false(stored: Value | None) -> bool:
    """Whether a constant is false."""
    return isinstance(stored, Const) and not stored.value


def is_member(owner: Value, held: object) -> bool:
    """Whether a class holds one of its own constants there: the member of an enumeration."""
    is_own = isinstance(held, Const) and isinstance(held.value, Member)
    return is_own and isinstance(owner, Class)


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
    return any(name in reassigned_attributes(base.node) for base in classes_of(cls))


def is_replaced(owner: Value, name: str) -> bool:
    """Whether a method puts something else where an entity, a lock or a function may be."""
    cls = owner.cls if isinstance(owner, Instance) else owner
    return any(name in replaced_attributes(base.node) for base in classes_of(cls))


def classes_of(cls: Value | None) -> Iterator[Class]:
    """A class and its bases, as far as they are of the program."""
    return (base for base in getattr(cls, 'mro', ()) if isinstance(base, Class))


def is_bare(world: World, is_used: bool) -> bool:
    """Whether each run comes to this use without a test, and an error here is not caught."""
    is_open = world.path != world.callback_path or bool(world.reading.passed)
    is_open = is_open or any(asked.names for asked in world.reading.loops)
    is_open = is_open or world.by_local
    return is_used and not is_open and all(_CATCHING.isdisjoint(names) for names in world.caught)
