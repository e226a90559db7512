"""
``sorted`` and ``id``: in which order things come that are taken in one order everywhere.

Locks of two objects that are taken in the order of ``sorted((a, b), key=…)`` are never taken the
other way round, whichever of the two came first.
"""

from __future__ import annotations

from typing import Any

from ros2cc_extract.extract.static.python.builtins.given_functions import called_at_once
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.object_identity import Identity
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Instance,
    Value,
)


def identity(machine: Machine, receiver: Value, call: Call) -> Value:
    """``id(…)``."""
    thing = call.args[0] if len(call.args) == 1 else NONE
    if isinstance(thing, Instance):
        return Identity(thing, call.place)
    return machine.mystery('id() of what could not be followed', call.place, 'id(…)')


def in_order(machine: Machine, receiver: Value, call: Call) -> Value:
    """``sorted(…)``, by its keys where these are known."""
    items = loops.items_in(machine, call.args[0] if call.args else NONE, call.place)
    known = items.known
    if items.others is None and not items.many and len(known) > 1:
        keys = [_key(machine, item, call) for item in known]
        known = _by_keys(known, keys, call) or _as_made(known)
    elif 'key' in call.keywords:
        called_at_once(machine, Call(call.place, [call.keywords['key']]))
    return Sequence(known, 'list', items.others, items.many)


def _key(machine: Machine, item: Value, call: Call) -> Value:
    key = call.argument(None, 'key')
    if key is None or key == NONE:
        return item
    return machine.call(key, Call(call.place, [item]))


def _by_keys(items: tuple[Value, ...], keys: list[Value], call: Call) -> tuple[Value, ...] | None:
    plain = [known for known in map(_plain, keys) if known is not None]
    backwards = call.argument(None, 'reverse') or Const(False)
    if len(plain) != len(items) or not isinstance(backwards, Const):
        return None
    try:
        order = sorted(
            range(len(items)), key=lambda place: plain[place], reverse=bool(backwards.value)
        )
    except TypeError:
        return None
    return tuple(items[place] for place in order)


def _plain(key: Value) -> tuple[Any, ...] | None:
    """What Python compares, if that is known, and something that comes in the same order."""
    parts = key.items if isinstance(key, Sequence) and key.rest is None else (key,)
    known = [
        part.thing.serial if isinstance(part, Identity) else part.value
        for part in parts
        if isinstance(part, (Const, Identity))
    ]
    return tuple(known) if len(known) == len(parts) else None


def _as_made(items: tuple[Value, ...]) -> tuple[Value, ...]:
    """
    Objects by the order in which they were made; others stay where they are.

    What the keys are is not known, but one key gives one order, wherever it is asked for.
    """
    objects = [item for item in items if isinstance(item, Instance)]
    if len(objects) != len(items):
        return items
    return tuple(sorted(objects, key=lambda thing: thing.serial))
