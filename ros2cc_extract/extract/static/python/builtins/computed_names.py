"""
Functions that are stored under a name which the program computes: ``setattr(self, name, f)``.

An attribute that nothing else has must be one of them. A method of that class may be hidden by
one, so that its call may call that instead.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from ros2cc_extract.extract.static.python.builtins.text_ends import ends_of
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.looked_up import LookedUp
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Heaped,
    Instance,
    Mystery,
    Partial,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import BY_CALLBACK, BY_NAME

_COMPUTED = '(computed)'
_CODE = (Bound, Function, Partial)


def keep(machine: Machine, owner: Value, name: Value, value: Value, place: Place) -> None:
    """``owner`` has the functions in ``value`` under a name that is not known."""
    found = [option for option in options_of(value) if isinstance(option, _CODE)]
    if not found or not isinstance(owner, (Instance, Class)):
        return
    ends = ends_of(name.node) if isinstance(name, Mystery) else None
    key = '\0'.join([_COMPUTED, *(ends or ('', '')), _text(name)])
    known = owner.slots.get(key)
    old = options_of(known) if isinstance(known, Value) else ()
    machine.store.write(owner, key, choice([*old, *found]))
    machine.world.computed_name = place


def held(machine: Machine, owner: Value, name: str) -> list[Value]:
    """What may be stored under ``name``."""
    if machine.world.computed_name is None or name.startswith('__'):
        return []
    found = list(_fitting(owner, name)) if isinstance(owner, (Instance, Class)) else []
    for cls in owner.mro if isinstance(owner, Instance) else ():
        for each in _fitting(cls, name) if isinstance(cls, Class) else ():
            found.append(Bound(owner, each) if isinstance(each, Function) else each)
    return found


def _fitting(owner: Heaped, name: str) -> Iterator[Value]:
    for key, value in owner.slots.items():
        if key.startswith(_COMPUTED) and isinstance(value, Value):
            _, first, last, _ = key.split('\0', 3)
            if name.startswith(first) and name.endswith(last):
                yield from options_of(value)


def stored_so(owner: Value, name: Value) -> Value | None:
    """What was stored in ``owner`` under a name that is computed in the same words."""
    text = _text(name)
    if not text or not isinstance(owner, Instance):
        return None
    ends = (key for key in owner.slots if key.startswith(_COMPUTED))
    known = next((owner.slots[key] for key in ends if key.split('\0', 3)[-1] == text), None)
    return known if isinstance(known, Value) else None


def _text(name: Value) -> str:
    node = name.node if isinstance(name, Mystery) else None
    return ast.unparse(node) if node is not None else ''


def note_hidden(machine: Machine, function: Value, name: str, call: Call) -> None:
    """A method is called that one of them may hide."""
    receiver = function.receiver if isinstance(function, Bound) else None
    others = held(machine, receiver, name) if receiver is not None else []
    if others and function not in others:
        place = machine.world.computed_name or call.place
        why = Unknown('a function that is stored under a computed name', place)
        machine.note_unknown_call(LookedUp(why, 'setattr(…)', others), Call(place))


def any_of_owner(owner: Value, name: Value, place: Place) -> Mystery:
    """``getattr(owner, name)``: any method so named, and whatever was stored under such a name."""
    ends = ends_of(name.node) if isinstance(name, Mystery) else None
    first, last = ends or ('', '')
    found: list[Value] = []
    for option in options_of(owner):
        if isinstance(option, Instance):
            known = [option, *(cls for cls in option.mro if isinstance(cls, Class))]
            for key, value in (item for each in known for item in each.slots.items()):
                is_named = key.startswith(first) and key.endswith(last)
                if (is_named or key.startswith(_COMPUTED)) and isinstance(value, Value):
                    codes = (each for each in options_of(value) if isinstance(each, _CODE))
                    found += (_method(option, each) for each in codes)
    why = Unknown('getattr with a computed name', place)
    return LookedUp(why, 'getattr(…)', found)


def _method(owner: Instance, code: Value) -> Value:
    """The function of a class as it is looked up in an object of it."""
    is_method = isinstance(code, Function) and code.binding == 'method'
    return Bound(owner, code) if is_method else code  # type: ignore[arg-type]


def note_any_called(machine: Machine, owner: Value, how: str, place: Place) -> None:
    """Any method of ``owner`` may be called here, by ``exec`` of a text that is not known."""
    note_by_name(machine, any_of_owner(owner, owner, place), how, place)


def note_by_name(machine: Machine, function: Value, how: str, place: Place) -> None:
    """One of several functions is called, it is not known which: each may use its data here."""
    if machine.world.effects is None or machine.world.only_data:
        return
    known = function.functions if isinstance(function, LookedUp) else ()
    by = how + (BY_NAME if machine.world.activity is not None else BY_CALLBACK)
    machine.note_handed([each for each in known if not _is_special(each)], place, by)


def _is_special(code: Value) -> bool:
    inner = code.function if isinstance(code, Bound) else code
    return isinstance(inner, Function) and inner.name.startswith('__')
