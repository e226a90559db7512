"""
Generators: the body of a generator function runs where items are taken from it.

What it does is done by the code that takes them: a callback that calls ``next`` on a generator
that the constructor has made waits for what the body waits for. All of the body is followed
there, once.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from ros2cc_extract.extract.static.program.generator_texts import first_yield, yields
from ros2cc_extract.extract.static.program.text_queries import noted_on
from ros2cc_extract.extract.static.python.machine.library_table import AWAITED
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.values.containers import Generator, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Function,
    Instance,
    Library,
    Native,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown

_TAKING = frozenset({'__next__', 'send', 'throw'})
_AWAITED = frozenset({'__anext__', 'asend', 'athrow'})
_KEEPING = frozenset({'builtins.iter', 'append', 'appendleft', 'add', 'insert', 'setdefault'})


def is_generator(function: Function) -> bool:
    """Whether a call of ``function`` runs nothing of it yet."""
    is_plain = isinstance(function.node, (ast.FunctionDef, ast.AsyncFunctionDef))
    return is_plain and noted_on(function.node, 'is_generator', yields)


@contextmanager
def handed_on(machine: Machine) -> Iterator[None]:
    """What is taken inside is handed on at once, as by ``yield from``."""
    world = machine.world
    before, world.handing_on = world.handing_on, world.one_by_one or world.turning
    try:
        yield
    finally:
        world.handing_on = before


def run(
    machine: Machine, value: Value, place: Place, *, is_one: bool = False, turns: bool = False
) -> None:
    """
    Items are taken from ``value``: if it is a generator, its body runs.

    :param is_one: it goes on up to its next ``yield``, not to its end.
    :param turns: what it yields goes to the executor, or the loop, that runs the coroutine.
    """
    if not isinstance(value, Generator):
        return
    # While nothing is noted, or in the set-up, the run itself stands for who takes the items.
    world = machine.world
    taker: Any = world.effects or world
    if value.slots.get('taker') is taker:
        return
    is_fresh = is_one and value.slots.get('taker') is None
    first = first_yield(value.function.node) if is_fresh and _is_done_once(machine) else None
    machine.store.write(value, 'taker', taker if first is None else value)
    machine.store.write(value, 'items', ())
    outer = world.one_by_one, world.turning, world.handing_on, world.first_yield
    world.turning = turns or (world.handing_on and world.turning)
    world.one_by_one = is_one or (world.handing_on and not world.turning)
    world.handing_on = False
    world.first_yield = first
    made = machine.run_function(value.function, _at(value.call, place))
    if first is not None and world.first_yield is None:
        world.stopped = False
    world.one_by_one, world.turning, world.handing_on, world.first_yield = outer
    if isinstance(made, Sequence):
        machine.store.write(value, 'items', made.items)
        more = Unknown('only its first item was taken', place) if first is not None else None
        machine.store.write(value, 'open', made.others or more)
        machine.store.write(value, 'many', made.many)
        yielding, held = machine.world.yielding or (None, ())
        machine.store.write(value, 'held', held if yielding is made else ())


def _is_done_once(machine: Machine) -> bool:
    """Whether the program does what is followed now once: in its set-up, and in no loop."""
    world = machine.world
    return world.effects is None and world.count == 1 and world.open_loops == 0


def run_given(machine: Machine, function: Value, call: Call) -> None:
    """Code that is not followed may take items from the generators that it gets."""
    if isinstance(function, Native) and function.name in _KEEPING:
        return
    is_one = isinstance(function, (Native, Library)) and function.name == 'builtins.next'
    for given in (*call.args, *call.keywords.values()):
        for option in options_of(given):
            run(machine, option, call.place, is_one=is_one)


def method(name: str, value: Generator) -> Value | None:
    """A method of a generator."""
    if name in _TAKING:
        return Native(name, _next, value)
    if name in _AWAITED:
        return Native(name, lambda machine, receiver, call: step_of(receiver), value)
    return Native(name, lambda *_: NONE, value) if name in ('close', 'aclose') else None


def step_of(value: Value) -> Value:
    """What gives the next item of an asynchronous generator once it is awaited."""
    taken = Instance(Library('builtins.async_generator_asend'), Place(''))
    taken.slots[AWAITED] = Native('__anext__', _next, value)
    return taken


def anext_of(machine: Machine, receiver: Value, call: Call) -> Value:
    """``anext(items)``."""
    given = call.args[0] if call.args else NONE
    if isinstance(given, Generator):
        return step_of(given)
    method = machine.special_method(given, '__anext__', call.place)
    return machine.call(method, Call(call.place)) if method is not None else given


def _next(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Generator)
    run(machine, receiver, call.place, is_one=True)
    unknown = machine.mystery('item of a generator', call.place, 'next(…)')
    return choice([*receiver.items, unknown]) if receiver.items else unknown


def _at(call: Call, place: Place) -> Call:
    """The same call, made where the items are taken; on one line it stays where it stands."""
    if (call.place.file, call.place.line) == (place.file, place.line):
        return call
    return Call(place, call.args, call.keywords, call.more, call.text, call.sources)
