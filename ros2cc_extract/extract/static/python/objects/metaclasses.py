"""What classes have beside what their text defines: metaclasses, and how objects are made."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Function,
    Native,
    Value,
)

_BOUND_BY_NAME = {
    '__new__': 'static',
    '__init_subclass__': 'class',
    '__class_getitem__': 'class',
}


def bind_by_name(name: str, value: Value) -> None:
    """Bind what Python makes static or a class method by its name alone (``type.__new__``)."""
    binding = _BOUND_BY_NAME.get(name)
    if binding is not None and isinstance(value, Function):
        value.binding = binding


def scanned_new(cls: Class) -> Function | None:
    """The ``__new__`` that ``cls`` has from its text or a scanned base."""
    for base in cls.mro:
        found = base.slots.get('__new__') if isinstance(base, Class) else None
        if isinstance(found, Function):
            return found
    return None


def of_metaclass(cls: Class, name: str, behind: Class | None = None) -> Value | None:
    """
    What the metaclass of ``cls`` gives it under ``name``.

    :param behind: look only at what comes after this class in the metaclass's order.
    """
    if cls.metaclass is None:
        return None
    order = cls.metaclass.mro
    if behind is not None and behind in order:
        order = order[order.index(behind) + 1 :]
    for base in order:
        found = base.slots.get(name) if isinstance(base, Class) else None
        if isinstance(found, Function):
            return Bound(cls, found)
        if isinstance(found, Value):
            return found
    return None


def _allocate(machine: Machine, receiver: Value, call: Call) -> Value:
    cls = call.args[0] if call.args else None
    if not isinstance(cls, Class):
        return machine.mystery('an object of a class that could not be followed', call.place)
    inner = Call(call.place, call.args[1:], call.keywords, call.more, call.text)
    return machine.allocate(cls, inner)


def _call_type(machine: Machine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Class):
        return machine.instantiate(receiver, call)
    cls = call.args[0] if call.args else None
    if not isinstance(cls, Class):
        return machine.mystery('an object of a class that could not be followed', call.place)
    inner = Call(call.place, call.args[1:], call.keywords, call.more, call.text)
    return machine.instantiate(cls, inner)


NEW = Native('__new__', _allocate)
"""``object.__new__``."""


def type_call(receiver: Value) -> Native:
    """``type.__call__``, bound to a class or to nothing."""
    return Native('type.__call__', _call_type, receiver)
