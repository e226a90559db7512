"""``heapq``, ``collections.ChainMap`` and ``functools.partialmethod``: what they hand on."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.builtins import builtin_methods
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.objects.loops import may_be_filled
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.partial_methods import PartialMethod
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Call,
    Handler,
    Mystery,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Unknown

_MOST = 40


def _push(machine: Machine, receiver: Value, call: Call) -> Value:
    """``heappush(heap, item)``."""
    heap = call.args[0] if call.args else NONE
    append = builtin_methods.method(heap, 'append') if isinstance(heap, Sequence) else None
    return machine.call(append, Call(call.place, call.args[1:])) if append else NONE


def _pop(machine: Machine, receiver: Value, call: Call) -> Value:
    """``heappop(heap)``: which item is the smallest is not known."""
    return machine.each(
        call.args[0] if call.args else NONE,
        lambda heap: _any_item(machine, heap, call),
        call.place,
    )


def _any_item(machine: Machine, heap: Value, call: Call) -> Value:
    unknown = machine.mystery('the smallest item of a heap', call.place, 'heappop(…)')
    if not isinstance(heap, Sequence) or not 0 < len(heap.items) <= _MOST:
        return unknown
    found = [each for item in heap.items for each in options_of(item) if each is not ABSENT]
    is_all = heap.others is None and not may_be_filled(machine, heap)
    return choice(found if is_all else [*found, unknown])


def _push_and_pop(machine: Machine, receiver: Value, call: Call) -> Value:
    _push(machine, receiver, call)
    return _pop(machine, receiver, call)


def _chained(machine: Machine, receiver: Value, call: Call) -> Value:
    """``ChainMap(first, second)``: a key of an earlier dictionary hides that of a later one."""
    entries: dict[Value, Value] = {}
    many: dict[Value, Value] = {}
    others: Unknown | None = call.more
    for given in reversed(call.args):
        if isinstance(given, Mapping):
            entries |= given.entries
            many |= given.many
            others = others or given.others
        else:
            why = given.unknown if isinstance(given, Mystery) else None
            others = others or why or Unknown('one of the dictionaries of a chain', call.place)
    return Mapping(entries, others, many)


def _partial_method(machine: Machine, receiver: Value, call: Call) -> Value:
    if not call.args:
        return machine.mystery('partialmethod without a function', call.place, 'partialmethod()')
    return PartialMethod(call.args[0], tuple(call.args[1:]), dict(call.keywords), call.more)


FUNCTIONS: dict[str, Handler] = {
    'heapq.heapify': lambda *_: NONE,
    'heapq.heappush': _push,
    'heapq.heappop': _pop,
    'heapq.heapreplace': _push_and_pop,
    'heapq.heappushpop': _push_and_pop,
    'collections.ChainMap': _chained,
    'functools.partialmethod': _partial_method,
}
