"""Which entities of an unknown node are one and the same, as far as the text shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.values.values import (
    NO_CALLER,
    Bound,
    Const,
    Function,
    Instance,
    Mystery,
    Partial,
    Value,
)
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Callback, Spec


def same_on_a_ghost(entity: EntityState) -> object:
    """
    Equal for entities that one line makes on one unknown node; ``None`` where that is known.

    Several objects of a class that were given the same unknown node made each of them.
    """
    if entity.node.state.ghost is None:
        return None
    return (
        id(entity.node),
        entity.kind,
        entity.place,
        entity.when,
        _name(entity.key),
        _group(entity.group),
        *(_code(callback) for callback in (entity.callback, *entity.extra_callbacks)),
    )


def _name(key: Value | None) -> object:
    if isinstance(key, Mystery):
        return key.text
    return key.value if isinstance(key, Const) else type(key)


def _group(group: Instance) -> object:
    return group.place, group.state.default, group.state.groupless


def _code(callback: Value | None) -> object:
    """Return a key that is equal for functions of one text, on any object."""
    if isinstance(callback, Partial):
        return _code(callback.function)
    function = callback.function if isinstance(callback, Bound) else callback
    if isinstance(function, Function):
        return id(function.node)
    return function.text if isinstance(function, Mystery) else type(function)


def each_once(units: Sequence[Spec]) -> tuple[Spec, ...]:
    """
    Units of unknown nodes alone are kept once, however many programs lead to them.

    A unit that only lacks a caller is left out if another unit has that caller.
    """
    known = [c for unit in units for c in unit.callbacks if isinstance(c.node, str)]
    owned = {_what(c) for c in known}
    named = {_line(c) for c in known if not _nobody_passes(c.key)}
    kept: dict[object, Spec] = {}
    for unit in units:
        if unit.callbacks and all(_is_reported(c, owned, named) for c in unit.callbacks):
            continue
        is_known = any(not isinstance(callback.node, Unknown) for callback in unit.callbacks)
        key = id(unit) if is_known else replace(unit, entry=None, sources=(), set_up=())
        kept.setdefault(key, unit)
    return tuple(kept.values())


def _is_reported(callback: Callback, owned: set[object], named: set[object]) -> bool:
    """Whether it only lacks a caller, and another unit has that caller."""
    if _nobody_passes(callback.key):
        return _line(callback) in named
    return _nobody_passes(callback.node) and _what(callback) in owned


def _nobody_passes(fact: object) -> bool:
    return isinstance(fact, Unknown) and fact.reason.endswith(NO_CALLER)


def _line(callback: Callback) -> object:
    """Return a key that is equal for one line that makes one thing, under any name on any node."""
    return callback.entity, callback.source, callback.function


def _what(callback: Callback) -> object:
    """Return a key that is equal for one line that makes one thing on any node."""
    return callback.entity, callback.source, callback.function, callback.key
