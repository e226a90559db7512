"""
What a loop goes over round by round: objects with ``__iter__`` and ``__next__``, repeated calls,
the lines of streams.

Source: CPython 3.12, ``iter(callable, sentinel)``, library reference, "Built-in Functions".
"""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Class,
    Heaped,
    Instance,
    Library,
    Native,
    Value,
)
from ros2cc_extract.source_locations import Place


class RepeatedCall(Heaped):
    """``iter(function, sentinel)``: each round calls ``function``, until it gives the sentinel."""

    __slots__ = ('function',)

    def __init__(self, function: Value) -> None:
        super().__init__()
        self.function = function


def iterator(call: Call) -> Value | None:
    """What ``iter`` of two arguments gives; ``None`` with another number of them."""
    return RepeatedCall(call.args[0]) if len(call.args) == 2 else None


def iterated(machine: Machine, value: Value, place: Place, *, is_async: bool = False) -> Value:
    """What a loop over ``value`` goes over: what an object's ``__iter__`` gives, else itself."""
    method = _method(machine, value, '__aiter__' if is_async else '__iter__', place)
    return machine.call(method, Call(place)) if method is not None else value


def next_of(
    machine: Machine, value: Value, place: Place, *, is_async: bool = False
) -> Callable[[], Value] | None:
    """Gives an item each time, where ``value`` is an iterator of its own."""
    if isinstance(value, RepeatedCall):
        return lambda: machine.call(value.function, Call(place))
    if is_async:
        taken = _method(machine, value, '__anext__', place)
        if taken is not None:
            return lambda: machine.await_value(machine.call(taken, Call(place)), place)
    method = _method(machine, value, '__next__', place) or _of_lines(machine, value, place)
    if method is None:
        return None
    return lambda: machine.call(method, Call(place))


def _of_lines(machine: Machine, value: Value, place: Place) -> Value | None:
    """``readline`` of a stream of a library, which gives its lines (library reference, ``io``)."""
    is_stream = isinstance(value, Instance) and isinstance(value.cls, Library)
    if not is_stream and not (isinstance(value, Library) and value.name == 'sys.stdin'):
        return None
    method = machine.attribute(value, 'readline', place)
    return method if isinstance(method, (Library, Native)) else None


def _method(machine: Machine, value: Value, name: str, place: Place) -> Bound | None:
    if not isinstance(value, Instance) or not isinstance(value.cls, Class):
        return None
    method = machine.attribute(value, name, place)
    return method if isinstance(method, Bound) else None
