"""``map``, ``filter`` and ``zip``: loops over several collections at once, without a statement."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects import loops
from ros2cc_extract.extract.static.python.values.assumed_defaults import (
    by_default,
    items_by_default,
)
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Call,
    Choice,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Unknown

_NEXT = 1


def zipped(machine: Machine, receiver: Value, call: Call) -> Value:
    mystery = next((arg for arg in call.args if isinstance(arg, Mystery)), None)
    default = by_default(
        call.args, lambda *held: zipped(machine, NONE, Call(call.place, list(held)))
    )
    if mystery is not None and default is not None and call.more is None:
        return Mystery(mystery.unknown, 'zip(…)', default)
    columns = [loops.items_in(machine, arg, call.place) for arg in call.args]
    rows: list[Value] = []
    for parts in zip(*(column.known for column in columns), strict=False):
        if any(_why_unsure(c, part) is not None for c, part in zip(columns, parts, strict=True)):
            break
        rows.append(Sequence(parts, 'tuple'))
    why = call.more or _why_more(columns, len(rows))
    if why is None:
        return Sequence(tuple(rows), 'list')
    parts = tuple(_from_there_on(column, len(rows), why) for column in columns)
    if all(isinstance(part, Mystery) for part in parts):
        return Sequence(tuple(rows), 'list', why)
    rows.append(Sequence(parts, 'tuple'))
    return Sequence(tuple(rows), 'list', None, {rows[-1]: Mystery(why)})


def _why_more(columns: list[loops.Items], length: int) -> Unknown | None:
    """Why there may be more rows than ``length``; a column that surely ends there ends all."""
    if any(len(column.known) == length and column.others is None for column in columns):
        return None
    whys = [
        why for c in columns for why in (c.others, *(_why_unsure(c, i) for i in c.known)) if why
    ]
    return whys[0] if whys else None


def _why_unsure(column: loops.Items, item: Value) -> Unknown | None:
    """Why ``item`` may stand at another position: it is several, or perhaps none."""
    if isinstance(item, Choice) and ABSENT in item.options:
        return Unknown('an item that may be missing')
    return column.why_many(item)


def _from_there_on(column: loops.Items, index: int, why: Unknown) -> Value:
    """What stands for every item of a column from ``index`` on."""
    left = column.known[index:]
    if len(left) == 1 and column.others is None and column.why_many(left[0]) is not None:
        return left[0]
    return Mystery(column.others or why, 'item')


def mapped(machine: Machine, receiver: Value, call: Call) -> Value:
    """``map(function, …)``, as if its result were asked for at once."""
    if len(call.args) < 2:
        return machine.mystery('map', call.place, 'map(…)')
    function, collections = call.args[0], call.args[1:]
    is_one = len(collections) == 1
    over = collections[0] if is_one else zipped(machine, NONE, Call(call.place, collections))
    results: list[Value] = []
    many: dict[Value, Value] = {}

    def once(item: Value) -> int:
        args = [item] if is_one else _row(item)
        result = machine.call(function, Call(call.place, args))
        results.append(result)
        if isinstance(machine.world.count, Unknown):
            many[result] = machine.why_many()
        return _NEXT

    items = loops.items_to_run(machine, over, call.place)
    loops.run_loop(machine, items, once, call.place)
    return Sequence(tuple(results), 'list', None, many)


def _row(item: Value) -> list[Value]:
    held = items_by_default(item)
    if isinstance(item, Sequence):
        held = item.items
    return list(held) if held else [item]


def filtered(machine: Machine, receiver: Value, call: Call) -> Value:
    """``filter(function, items)``: what surely passes, and what may."""
    if len(call.args) != 2:
        return machine.mystery('filter', call.place, 'filter(…)')
    function, collection = call.args
    items = loops.items_in(machine, collection, call.place)
    kept: list[Value] = []
    many = dict(items.many)

    def once(item: Value) -> int:
        asked = item if function == NONE else machine.call(function, Call(call.place, [item]))
        holds = machine.truth(asked)
        if holds is not False:
            kept.append(item)
        if holds is None or isinstance(machine.world.count, Unknown):
            why = Unknown('a condition that could not be followed', call.place)
            many[item] = machine.why_many() if holds else Mystery(why)
        return _NEXT

    loops.run_loop(machine, items, once, call.place)
    return Sequence(tuple(kept), 'list', None, many)
