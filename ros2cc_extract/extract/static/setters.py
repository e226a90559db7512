"""Who ends a wait for an event or a future."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.world import EntityState


def the_setter(setters: Sequence[EntityState | None]) -> EntityState | None:
    """
    The one callback that sets something; ``None`` where it may be set otherwise.

    Inputs of one message filter run one function in one group: the first stands for all, since
    whatever keeps one of them from running keeps them all.
    """
    first = setters[0] if setters else None
    if first is None or not all(_alike(first, setter) for setter in setters):
        return None
    return first


def _alike(first: EntityState, other: EntityState | None) -> bool:
    if other is None or first is other:
        return other is not None
    is_input = first.library is not None and first.library == other.library
    same_function = first.callback is not None and first.callback is other.callback
    return is_input and same_function and first.group is other.group
