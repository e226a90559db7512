"""Methods that are found by the beginning or the end of a name."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.python.builtins.computed_names import any_of_owner, stored_so
from ros2cc_extract.extract.static.python.builtins.text_ends import ends_of
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import AccessKind
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Class,
    Const,
    Function,
    Instance,
    Mystery,
    Value,
    choice,
    options_of,
)

_MANY = 40


def get_attribute(machine: Machine, receiver: Value, call: Call) -> Value:
    """``getattr(owner, name)``."""
    if len(call.args) < 2 or not isinstance(call.args[1], Const):
        owner, asked = (*call.args, NONE, NONE)[:2]
        stored = stored_so(owner, asked)
        like = _methods_named_like(machine, call) if len(call.args) > 1 else None
        if stored is not None and like is not None and machine.world.effects is not None:
            return choice([*options_of(stored), *options_of(like)])  # of another word, perhaps
        return stored or like or any_of_owner(owner, asked, call.place)
    name = str(call.args[1].value)

    def of(owner: Value) -> Value:
        machine.note_attribute(owner, name, AccessKind.READ, call.place)
        exists = machine.has_attribute(owner, name)
        default = call.argument(2)
        if exists is False and default is not None:
            return default
        found = machine.attribute(owner, name, call.place)
        if exists is None and default is not None and isinstance(found, Mystery):
            return choice([found, default])
        return found

    return choice([of(owner) for owner in options_of(call.args[0])])


def _methods_named_like(machine: Machine, call: Call) -> Value | None:
    """What ``getattr(owner, 'do_' + word)`` may give: each method so named, or the default."""
    name = call.args[1]
    ends = ends_of(name.node) if isinstance(name, Mystery) else None
    if ends is None:
        return None
    found: list[Value] = []
    for owner in options_of(call.args[0]):
        if not isinstance(owner, Instance):
            return None
        names = dict.fromkeys(_methods(owner, *ends))
        found += (machine.attribute(owner, each, call.place) for each in names)
    default = call.argument(2)
    if not 0 < len(found) <= _MANY:
        return None
    return choice([*found, default] if default is not None else found)


def _methods(owner: Instance, first: str, last: str) -> Iterator[str]:
    for cls in owner.mro:
        for name, value in cls.slots.items() if isinstance(cls, Class) else ():
            is_named = name.startswith(first) and name.endswith(last)
            if isinstance(value, Function) and is_named and len(name) > len(first + last):
                yield name
