"""
Functions that the interpreter calls when the program ends, in its main thread.

Source: CPython 3.12, ``atexit`` (the last one registered is called first).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.machine.machine import ConcurrentMachine
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Value


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
    """Follow what was registered, behind all that ``main`` does."""
    hooks = machine.world.exit_hooks
    while hooks:
        function, call = hooks.pop()
        machine.call(function, call)
