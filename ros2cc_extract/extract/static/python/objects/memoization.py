"""
Calls that give one object again: ``lru_cache``, ``cached_property``, and what may do so unseen.

Source: CPython 3.12, ``functools.py`` (one result for each arguments, by position and by name).
"""

from __future__ import annotations

import ast
from collections.abc import Callable

from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    Call,
    Choice,
    Class,
    Function,
    Heaped,
    Instance,
    Mystery,
    Native,
    Value,
    options_of,
    present,
    source_text,
)

_KEPT = '__kept__'

Run = Callable[[Call], Value]


def keep_results(machine: Machine, receiver: Value, call: Call) -> Value:
    """``functools.lru_cache`` and ``functools.cache``, bare or with options."""
    function = call.args[0] if call.args else None
    if isinstance(function, Function):
        machine.store.write(function, _KEPT, _Results())
        return function
    if isinstance(function, Class):
        return Native('lru_cache', _kept_class(function, _Results()), function)
    return Native('lru_cache(…)', keep_results)


def keep_if_cached(machine: Machine, function: Function, decorator: str) -> None:
    """``@cached_property`` asks once for each object (``functools.py``)."""
    if decorator == 'cached_property':
        machine.store.write(function, _KEPT, _Results())


class _Results(Heaped, Value):
    """Slots: arguments of a call -> its result."""

    __slots__ = ()


def _kept_class(cls: Class, results: _Results) -> Callable[[Machine, Value, Call], Value]:
    def make(machine: Machine, receiver: Value, call: Call) -> Value:
        return _recall(machine, results, call, lambda call: machine.call(cls, call))

    return make


def is_kept(function: Function) -> bool:
    """Whether ``function`` runs once for each arguments."""
    return _KEPT in function.slots


def recall(machine: Machine, function: Function, call: Call, run: Run) -> Value:
    """The result of the first call with the same arguments, else that of ``run``."""
    results = function.slots[_KEPT]
    assert isinstance(results, _Results)
    known = len(results.slots)
    result = _recall(machine, results, call, run)
    if len(results.slots) > known:
        for option in options_of(result):
            if isinstance(option, Instance):
                option.born = None  # the callback that asks first has it not for itself
            machine.note_held(function, f'result#{known + 1}' if known else 'result', option)
    return result


def _recall(machine: Machine, results: _Results, call: Call, run: Run) -> Value:
    key = _key(call)
    held = results.slots.get(key, ABSENT)
    if held is not ABSENT:
        # Made on one branch or on another, it is one object.
        return present(held) if isinstance(held, Choice) else _known(held)
    others, made = len(results.slots), machine.objects_made()
    result = run(call)
    machine.store.write(results, key, result)
    if others and _is_unsure(call):
        reason = 'what is kept for other arguments may be the same; these could not be followed'
        machine.doubt_objects(made, reason, call.place)
    return result


def _known(value: object) -> Value:
    assert isinstance(value, Value)
    return value


def _key(call: Call) -> object:
    named = sorted(call.keywords.items(), key=lambda item: item[0])
    return (*map(_token, call.args), *((name, _token(value)) for name, value in named))


def _token(value: Value) -> object:
    return (value.text, value.unknown) if isinstance(value, Mystery) else value


def _is_unsure(call: Call) -> bool:
    given = (*call.args, *call.keywords.values())
    return call.more is not None or any(isinstance(value, (Mystery, Choice)) for value in given)


def doubt(world: World, made: Class | Function, how: str, text: ast.expr) -> None:
    """Keep in mind that code which is not scanned stands between a call and ``made``."""
    world.doubted[made] = f'{made.name} {how} {source_text(text)}, which is not scanned'


def doubted(machine: Machine, made: Class | Function, call: Call, run: Run) -> Value:
    """Run a call; from the second one on it may give what the first one gave."""
    why = machine.world.doubted.get(made)
    if why is None:
        return run(call)
    before = machine.objects_made()
    result = run(call)
    machine.world.doubted_calls[made] += 1
    if machine.world.doubted_calls[made] > 1:
        machine.doubt_calls(before, why, call.place)
    return result
