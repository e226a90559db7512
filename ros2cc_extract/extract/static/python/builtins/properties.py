"""Properties: what reads an attribute, what assigns it and what deletes it."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Call, Function, Value

ACCESSORS = {'setter': '<setter>', 'deleter': '<deleter>'}


def with_accessor(
    machine: Machine, known: Value, kind: str, accessor: Function
) -> Function | None:
    """``@known.setter``: a property like ``known`` that is assigned by calling ``accessor``."""
    if not isinstance(known, Function) or known.binding != 'property':
        return None
    made = _property(known)
    for name in ACCESSORS.values():
        if name in known.slots:
            machine.store.write(made, name, known.slots[name])
    machine.store.write(made, ACCESSORS[kind], accessor)
    return made


def made_property(machine: Machine, receiver: Value, call: Call) -> Value:
    """``property(get, set, delete)``."""
    getter = call.argument(0, 'fget')
    others = {'setter': call.argument(1, 'fset'), 'deleter': call.argument(2, 'fdel')}
    known = next((o for o in (getter, *others.values()) if isinstance(o, Function)), None)
    if known is None:
        return machine.mystery('a property that is not followed', call.place, 'property(…)')
    made = _property(known)
    made.binding = 'property'
    for kind, accessor in others.items():
        if isinstance(accessor, Function):
            machine.store.write(made, ACCESSORS[kind], accessor)
    return made


def _property(known: Function) -> Function:
    made = Function(known.node, known.module, known.qualname, known.scope)
    made.owner, made.binding = known.owner, known.binding
    return made
