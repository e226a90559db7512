"""
Simulated time: the clock of a node stands still until the node has taken a message of ``/clock``.

A node whose parameter ``use_sim_time`` is set subscribes to it in its default group; sleeps and
rates of its clock end there, and functions for jumps of time run inside. Sources: rclpy 7.1.6 and
9.1.2, ``time_source.py``, ``clock.py`` (``sleep_until``, ``create_jump_callback``), ``timer.py``
(``Rate``).
"""

from __future__ import annotations

from collections.abc import Iterable

from ros2cc_extract.extract.static.libraries.rclpy.machine.durations import CLOCKS, THE_CLOCK
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind

_CLOCK = 'rclpy.clock.ROSClock'
_CALLBACK = 'rclpy.time_source.TimeSource.clock_callback'
_PARAMETER = 'use_sim_time'
TOPIC = '/clock'


def start_sim_time(
    machine: RosMachine, node: Instance, parameters: Iterable[Value], place: Place
) -> EntityState | None:
    """The subscription of a node that is set to use simulated time."""
    state = node.state
    if not isinstance(state, NodeState) or state.sim_clock is not None:
        return None
    world = machine.world
    is_given = world.parameters.values.get(_PARAMETER) is True
    if not is_given and not any(_is_sim_time(value) for value in parameters):
        return None
    group = group_of(machine, node, None, place)
    entity = EntityState(EntityKind.SUBSCRIPTION, node, group, place, path=world.path)
    entity.count, entity.when, entity.builtin = world.count, world.when, True
    entity.key, entity.callback = Const(TOPIC), Name(_CALLBACK)
    entity.number = len(world.entities) + len(world.builtins)
    state.sim_clock = entity
    return entity


def items_of(value: Value | None) -> tuple[Value, ...]:
    """The parameters of a list that is given."""
    return value.items if isinstance(value, Sequence) else ()


def _is_sim_time(value: Value) -> bool:
    state = value.state if isinstance(value, Instance) else None
    return (
        isinstance(state, PlainState)
        and state.of == Const(_PARAMETER)
        and state.key == Const(True)
    )


def note_sleep(machine: RosMachine, name: str, node: Value | None, place: Place) -> None:
    """Note a wait for the simulated time of ``node``, if it has any."""
    clock = node.state.sim_clock if isinstance(node, Instance) else None
    if isinstance(clock, EntityState):
        machine.note_messages(name, clock, place)


def serve(world: RosWorld, clock: EntityState) -> None:
    """What rclpy has made matters from here on: code waits for it."""
    known = world.by_node.setdefault(id(clock.node), [])
    if clock not in known and clock not in world.builtins:
        world.entities.append(clock)
        known.append(clock)


def clock_of(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``get_clock()``; that of a node without simulated time is not followed."""
    state = receiver.state if isinstance(receiver, Instance) else None
    if not isinstance(state, NodeState) or state.sim_clock is None:
        return machine.mystery(THE_CLOCK, call.place, THE_CLOCK)
    clock = Instance(Name(_CLOCK), call.place)
    clock.state = PlainState('clock', of=receiver, place=call.place)
    return clock


def _sleep(name: str) -> Handler:
    def sleep(machine: RosMachine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Instance)
        note_sleep(machine, CLOCKS[name], receiver.state.of, call.place)
        return machine.mystery(f'result of {name}', call.place)

    return sleep


def _now(machine: RosMachine, receiver: Value, call: Call) -> Value:
    node = receiver.state.of if isinstance(receiver, Instance) else None
    clock = node.state.sim_clock if isinstance(node, Instance) else None
    asked = machine.world.asked_messages
    if isinstance(clock, EntityState) and clock not in asked:
        asked.append(clock)
    return machine.mystery(THE_CLOCK, call.place, f'{THE_CLOCK}.now')


def _create_jump_callback(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Its functions run inside the subscription that moves the clock."""
    assert isinstance(receiver, Instance)
    node = receiver.state.of
    clock = node.state.sim_clock if isinstance(node, Instance) else None
    for part in ('pre_callback', 'post_callback'):
        given = call.argument(None, part)
        if not isinstance(clock, EntityState) or given is None or given == NONE:
            continue
        if clock.builtin:
            clock.builtin, clock.library, clock.callback = False, 'rclpy.time_source', given
            if clock in machine.world.builtins:
                machine.world.builtins.remove(clock)
        elif given not in (clock.callback, *clock.extra_callbacks):
            clock.extra_callbacks += (given,)
        serve(machine.world, clock)
    return machine.mystery('a jump handle', call.place)


TABLE = Library(
    classes={
        _CLOCK: LibraryClass(
            state=lambda machine, instance: PlainState('clock', place=instance.place),
            methods={
                **{name: _sleep(name) for name in CLOCKS},
                'now': _now,
                'create_jump_callback': _create_jump_callback,
            },
        ),
    },
)
