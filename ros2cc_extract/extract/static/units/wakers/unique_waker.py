"""What ends a wait for an event, a future, a queue …"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    EntityRef,
    SettableRef,
    Waking,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.source_locations import Unknown

_SETTING = frozenset({Word.SET})


def the_setter(wakings: Sequence[Waking], words: frozenset[Word] = _SETTING) -> EntityState | None:
    """
    The one callback that sets something; ``None`` where it may be set otherwise.

    Inputs of one message filter run one function in one group: the first stands for all, since
    what keeps one of them from running keeps them all.
    """
    setters = [waking.by for waking in wakings if waking.word in words]
    first = setters[0] if setters else None
    if not isinstance(first, EntityState) or not all(_alike(first, by) for by in setters):
        return None
    return first


def _alike(first: EntityState, other: object) -> bool:
    if not isinstance(other, EntityState) or first is other:
        return first is other
    is_input = first.library is not None and first.library == other.library
    same_function = first.callback is not None and first.callback is other.callback
    return is_input and same_function and first.group is other.group


def waited_name(on: object, names: dict[int, str]) -> str | Unknown | None:
    """What is waited for, by the ``names`` of the unit, by identity."""
    if isinstance(on, SettableRef):
        return names.get(on.number) or str(on)
    if isinstance(on, EntityRef):
        return names.get(on.number) or Unknown('an entity of another executor')
    return on if isinstance(on, (str, Unknown)) else None
