"""
Functions that the operating system has called: handlers of signals.

A handler runs between two lines of the main thread, whenever the outside likes. What it stores
ends the loops that test it, and what it sets, puts or notifies ends waits. While it waits itself,
the main thread spins nothing.
Source: CPython 3.12, ``signal`` (handlers run in the main thread, after the signal has come).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ActivityState,
    ConcurrentWorld,
    OutsideWait,
    SetUpWait,
)
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Class,
    Function,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import ActivityKind


def on_signal(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``signal.signal(number, handler)``."""
    _add_handlers(machine, call, interrupts=True)
    return machine.mystery('the handler before', call.place, 'signal.signal(…)')


def on_signal_of_loop(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``loop.add_signal_handler(number, callback)``: the loop runs it, between two callbacks."""
    _add_handlers(machine, call, interrupts=False)
    return NONE


def _add_handlers(machine: ConcurrentMachine, call: Call, *, interrupts: bool) -> None:
    for option in options_of(call.argument(1, 'handler', 'callback') or NONE):
        handler = _beside(option, call.place)
        handler.interrupts = interrupts
        machine.world.signal_handlers.append(handler)
        function = option.function if isinstance(option, Bound) else option
        if isinstance(function, Function):
            for name, place in _stored_by(function, option):
                machine.world.other_writes.setdefault(name, (None, place))


def note_followed(world: ConcurrentWorld, handler: ActivityState) -> None:
    """What a handler has stored by calls and what it waits for, now that it was followed."""
    for access in handler.effects.writes:
        if access.source is not None:
            world.other_writes.setdefault(access.name, (None, access.source))
    for block in handler.effects.blocking:
        place = block.source or handler.place
        wait = OutsideWait(block.call, None, place, in_thread=False)
        own = SetUpWait(replace(block, chain=()), wait, in_handler=True)
        world.set_up.setdefault((block.call, place, handler.place), own)


def _beside(handler: Value, place: Place) -> ActivityState:
    """It is followed like a thread, but is not one: nothing starts it, and no unit has it."""
    unknown = Unknown('what the system gives a handler of a signal', place)
    return ActivityState(ActivityKind.THREAD, place, handler, Call(place, more=unknown))


def _stored_by(function: Function, handler: Value) -> Iterator[tuple[str, Place]]:
    """The globals and attributes that stand in its text as stored."""
    parts = list(walk(function.node))
    shared = {name for part in parts if isinstance(part, ast.Global) for name in part.names}
    owner = handler.receiver if isinstance(handler, Bound) else None
    cls = owner.cls if isinstance(owner, Instance) else owner
    for part in parts:
        if not isinstance(getattr(part, 'ctx', None), ast.Store):
            continue
        if isinstance(part, ast.Name) and part.id in shared:
            yield f'{function.module.name}.{part.id}', _at(function, part)
        elif isinstance(part, ast.Attribute) and isinstance(cls, Class):
            yield f'{cls.name}.{part.attr}', _at(function, part)


def _at(function: Function, part: ast.expr) -> Place:
    return Place(function.place.file, part.lineno, part.col_offset + 1)
