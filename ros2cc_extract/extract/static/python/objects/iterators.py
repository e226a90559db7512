"""Objects of the program that a loop goes over: what their ``__iter__`` and ``__next__`` do."""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import Bound, Call, Class, Instance, Value
from ros2cc_extract.places import Place


def iterated(machine: Machine, value: Value, place: Place) -> Value:
    """What a loop over ``value`` goes over: what an object's ``__iter__`` gives, else itself."""
    method = _method(machine, value, '__iter__', place)
    return machine.call(method, Call(place)) if method is not None else value


def next_of(machine: Machine, value: Value, place: Place) -> Callable[[], Value] | None:
    """Gives an item each time, where ``value`` is an object with ``__next__``."""
    method = _method(machine, value, '__next__', place)
    if method is None:
        return None
    return lambda: machine.call(method, Call(place))


def _method(machine: Machine, value: Value, name: str, place: Place) -> Bound | None:
    if not isinstance(value, Instance) or not isinstance(value.cls, Class):
        return None
    method = machine.attribute(value, name, place)
    return method if isinstance(method, Bound) else None
