"""
Functions that the interpreter calls when the program ends, in its main thread.

Source: CPython 3.12, ``atexit`` (the last one registered is called first), ``pylifecycle.c``
(``Py_FinalizeEx`` waits for all threads that are no daemons and for those of pools before; run on
3.11).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import joined_by_exit
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Value, options_of
from ros2cc_extract.spec.model import ActivityKind


def on_exit(machine: ConcurrentMachine, receiver: Value, call: Call) -> Value:
    """``atexit.register(function, *args, **kwargs)``."""
    function = call.argument(0, 'func')
    if function is None:
        return NONE
    world = machine.world
    if world.in_callback or world.in_thread or not world.is_program:
        world.escaped.append((function, call.place))
    else:
        hook = Call(call.place, call.args[1:], call.keywords, call.more)
        world.exit_hooks.append((function, hook))
    return function


def run_exit_hooks(machine: ConcurrentMachine) -> None:
    """Follow what was registered, behind all that ``main`` does and the threads that keep it."""
    world = machine.world
    hooks = world.exit_hooks
    with joined_by_exit(world, _keeping(world)):
        while hooks:
            function, call = hooks.pop()
            machine.call(function, call)


def _keeping(world: ConcurrentWorld) -> list[Value]:
    """The threads that the set-up has started for sure and that are no daemons."""
    kinds = (ActivityKind.THREAD, ActivityKind.POOL)
    own = [
        state
        for state in world.activities
        if state.kind in kinds and state.is_daemon is False and not state.path
        if state.starts and all(start.by is None for start in state.starts)
    ]
    return [option for state in own for each in state.runners for option in options_of(each)]
