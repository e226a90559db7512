"""
The end of rclpy: ``rclpy.shutdown``, contexts, and the functions that run when one ends.

Source: rclpy 7.1.6 and 9.1.2, ``context.py`` (``shutdown`` runs the functions of ``on_shutdown``
in its caller, in their order; so does the end of a ``with`` over it), ``__init__.py``
(``shutdown`` is that of the default context); 9.1.2, ``__init__.py`` (``with rclpy.init():``
shuts down at its end).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.waits.outside_waits import note_over
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import note_shutdown
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Instance,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place

CONTEXT = 'rclpy.context.Context'
_INIT = 'rclpy.InitContextManager'
_HOOKS = '__on_shutdown__'


class _ContextState(PlainState):
    """What ``with`` does with a context is a method of it."""

    is_block = False


def default_context(machine: RosMachine) -> Instance:
    """The context of every node that is given no other."""
    world = machine.world
    if world.context is None:
        world.context = Instance(Name(CONTEXT), Place(''))
        world.context.state = _ContextState('context')
    return world.context


def context_of_node(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    """``node.context``; a node that is given one of its own is rare, and keeps it elsewhere."""
    return default_context(machine)


def _on_shutdown(machine: RosMachine, receiver: Value, call: Call) -> Value:
    callback = call.argument(0, 'callback')
    if isinstance(receiver, Instance) and callback is not None:
        hooks = receiver.slots.get(_HOOKS, ())
        if callback not in hooks:
            machine.store.write(receiver, _HOOKS, (*hooks, callback))
    return NONE


def _shut_down(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Spins that go on in other threads end; what waits for the end runs here."""
    world = machine.world
    if world.in_callback or world.in_thread:
        note_shutdown(machine, call.place)
    else:
        world.spins_over = len(world.spins)
        note_over(world, None)
    given = receiver if isinstance(receiver, Instance) else call.argument(0, 'context')
    context = given if isinstance(given, Instance) else default_context(machine)
    before, world.shutting_down = world.shutting_down, True
    for hook in context.slots.get(_HOOKS, ()):
        machine.call(hook, Call(call.place))
    world.shutting_down = before
    return NONE


def _entered(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return receiver


def _left(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """The end of ``with rclpy.init():`` or of a ``with`` over a context."""
    is_context = isinstance(receiver, Instance) and receiver.cls == Name(CONTEXT)
    return _shut_down(machine, receiver if is_context else NONE, Call(call.place))


def _init(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return Instance(Name(_INIT), call.place)


TABLE = Library(
    classes={
        CONTEXT: LibraryClass(
            state=lambda machine, instance: _ContextState('context', place=instance.place),
            methods={
                'on_shutdown': _on_shutdown,
                'shutdown': _shut_down,
                'try_shutdown': _shut_down,
                '__enter__': _entered,
                '__exit__': _left,
            },
        ),
        _INIT: LibraryClass(methods={'__enter__': _entered, '__exit__': _left}),
    },
    functions={
        'rclpy.init': _init,
        'rclpy.shutdown': _shut_down,
        'rclpy.try_shutdown': _shut_down,
        'rclpy.get_default_context': lambda machine, receiver, call: default_context(machine),
    },
    aliases={
        'rclpy.Context': CONTEXT,
        'rclpy.utilities.get_default_context': 'rclpy.get_default_context',
        'rclpy.utilities.shutdown': 'rclpy.shutdown',
        'rclpy.utilities.try_shutdown': 'rclpy.try_shutdown',
    },
)
