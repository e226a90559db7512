"""
Functions of Python that call what they are given, once for each item, or perhaps.

What is called only as its result is asked for (``itertools``) is taken to be called at once, as
with ``map``. Source: CPython 3.12, library reference of each.
"""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Value
from ros2cc_extract.light_dataclasses import dataclass

_NEXT = 1
Arguments = Callable[[Machine, Value, Call], list[Value]]


def _item(machine: Machine, item: Value, call: Call) -> list[Value]:
    return [item]


def _pair(machine: Machine, item: Value, call: Call) -> list[Value]:
    return [machine.mystery('what the calls before have given', call.place, 'so far'), item]


def _spread(machine: Machine, item: Value, call: Call) -> list[Value]:
    return list(machine.items_of(item, call.place)[0])


@dataclass(frozen=True)
class Taker:
    """
    :param function: where the function stands, and its name; as for ``Call.argument``.
    :param items: where the items stand; ``None`` where they are in the receiver.
    :param arguments: what it is called with.
    """

    function: tuple[int | None, str]
    items: int | None = 0
    arguments: Arguments = _item


TAKERS = {
    'builtins.max': Taker((None, 'key')),
    'builtins.min': Taker((None, 'key')),
    'functools.reduce': Taker((0, 'function'), 1, _pair),
    'itertools.accumulate': Taker((1, 'func'), 0, _pair),
    'itertools.groupby': Taker((1, 'key')),
    'itertools.takewhile': Taker((0, 'predicate'), 1),
    'itertools.dropwhile': Taker((0, 'predicate'), 1),
    'itertools.filterfalse': Taker((0, 'function'), 1),
    'itertools.starmap': Taker((0, 'function'), 1, _spread),
    'heapq.nlargest': Taker((2, 'key'), 1),
    'heapq.nsmallest': Taker((2, 'key'), 1),
}


def run(machine: Machine, name: str, call: Call) -> None:
    """Call what the function ``name`` of Python is given to call, if it is such a one."""
    taker = TAKERS.get(name)
    if taker is None:
        return
    items = call.argument(taker.items) if taker.items is not None else None
    call_each(machine, call.argument(*taker.function), items or NONE, call, taker.arguments)


def call_each(
    machine: Machine,
    function: Value | None,
    collection: Value,
    call: Call,
    arguments: Arguments = _item,
) -> None:
    """Call ``function``, if there is one, with each item of ``collection``."""
    if function is None or function == NONE:
        return

    def once(item: Value) -> int:
        machine.call(function, Call(call.place, arguments(machine, item, call)))
        return _NEXT

    loops.run_loop(machine, loops.items_in(machine, collection, call.place), once, call.place)


def sort(machine: Machine, receiver: Value, call: Call) -> Value:
    """``list.sort(key=…)``."""
    call_each(machine, call.argument(None, 'key'), receiver, call)
    return NONE
