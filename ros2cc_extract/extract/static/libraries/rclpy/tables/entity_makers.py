"""
Libraries that make entities on a node's behalf.

Sources (Jazzy): ``tf2_ros/transform_listener.py`` (two subscriptions in a reentrant group of
its own; ``spin_thread`` adds a single-threaded executor), ``message_filters/__init__.py``
(one subscription each), ``diagnostic_updater/_diagnostic_updater.py`` (one timer),
``tf2_ros/buffer.py`` and ``buffer_interface.py`` (a look-up with a timeout polls and sleeps).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    ExecutorState,
    GroupState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import (
    SINGLE,
    add_node,
    as_node,
    record_spin,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of, new_group
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import add_callback, add_entity
from ros2cc_extract.extract.static.python.machine import path_facts
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.containers import Sequence
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import EntityKind, GroupType

_TF = 'tf2_ros.TransformListener'
_FILTERS = 'message_filters'
_SYNCHRONIZES, _LOCK = 'synchronizer', '__lock__'
_UPDATER = 'diagnostic_updater.Updater'
_LATEST = 'rclpy.time.Time()'
_LONGEST = 2**63
"""rclpy counts a duration in signed 64 bit nanoseconds."""


def _listen(machine: RosMachine, receiver: Value, call: Call) -> Value:
    node = as_node(machine, call.argument(1, 'node'))
    if node is None:
        return NONE
    state = GroupState(type=GroupType.REENTRANT, library=_TF)
    group = new_group(machine, state, call.place, 'tf')
    for topic, label in (('/tf', 'tf_callback'), ('/tf_static', 'tf_static_callback')):
        entity = add_entity(machine, node, EntityKind.SUBSCRIPTION, group, call.place)
        entity.key, entity.label, entity.library = Const(topic), label, _TF
        if topic == '/tf' and isinstance(receiver, Instance):
            receiver.state = entity
    _fill(call.argument(0, 'buffer'), receiver)
    if machine.truth(call.argument(2, 'spin_thread') or Const(False)):
        _spin_thread(machine, node, call)
    return NONE


def _fill(buffer: Value | None, listener: Value) -> None:
    """What a look-up waits for: the messages that the listener of its buffer takes."""
    if isinstance(buffer, Instance) and isinstance(buffer.state, PlainState):
        buffer.state.of = listener


def _spin_thread(machine: RosMachine, node: Instance, call: Call) -> None:
    executor = Instance(Name(SINGLE), call.place)
    executor.state = ExecutorState('SingleThreadedExecutor')
    executor.slots['__nodes__'] = ()
    executor.hint = 'tf_executor'
    machine.world.executors.append(executor)
    add_node(machine, executor, node)
    world, before = machine.world, (machine.world.in_thread, machine.world.thread)
    world.threads += 1
    world.in_thread, world.thread = True, world.threads
    record_spin(machine, executor, 'spin', call.place, True)
    world.in_thread, world.thread = before


def _subscribe(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``Subscriber(node, type, topic, …)``; further arguments go to ``create_subscription``."""
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is None:
        return NONE
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    entity = add_entity(machine, node, EntityKind.SUBSCRIPTION, group, call.place)
    entity.key, entity.library = call.argument(2, 'topic'), _FILTERS
    entity.type, entity.qos = call.argument(1, 'msg_type'), call.argument(None, 'qos_profile')
    entity.label = 'filter_input'
    receiver.state = entity
    return NONE


def _subscription(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    """``Subscriber.sub``: what ``create_subscription`` gave it."""
    made = Instance(Name('rclpy.subscription.Subscription'), receiver.place)
    made.state = receiver.state
    return made


def _filter_state(machine: RosMachine, instance: Instance) -> PlainState:
    return PlainState('filter', place=instance.place)


def _synchronize(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    receiver.state = PlainState(_SYNCHRONIZES, of=call.argument(0, 'fs'), place=call.place)
    return NONE


def _cache(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    receiver.state = PlainState('filter', of=call.argument(0, 'f'), place=call.place)
    return NONE


def _register(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Every input's subscription runs the user's function when its message is the last."""
    callback = call.argument(0, 'cb')
    for entity in _inputs(receiver):
        if callback is not None:
            add_callback(entity, callback)
            lock = _lock_of(receiver)
            same = entity.called_under.get(callback, lock) is lock
            entity.called_under[callback] = lock if same else None
    return machine.mystery('a filter connection', call.place)


def _lock_of(receiver: Value) -> Instance | None:
    """
    The lock that a synchronizer holds while it calls the functions that wait for all inputs.

    Source: ``message_filters/__init__.py`` (``TimeSynchronizer.add``); other filters have none.
    """
    if not (isinstance(receiver, Instance) and isinstance(receiver.state, PlainState)):
        return None
    if receiver.state.kind != _SYNCHRONIZES:
        return None
    lock = receiver.slots.get(_LOCK)
    if not isinstance(lock, Instance):
        lock = receiver.slots[_LOCK] = Instance(Name('threading.Lock'), receiver.place)
        lock.hint, lock.state = f'{receiver.hint or "synchronizer"}_lock', PlainState('lock')
    return lock


def _inputs(value: Value) -> list[EntityState]:
    if isinstance(value, Sequence):
        return [entity for item in value.items for entity in _inputs(item)]
    if not isinstance(value, Instance):
        return []
    if isinstance(value.state, EntityState):
        return [value.state]
    if isinstance(value.state, PlainState) and value.state.of is not None:
        return _inputs(value.state.of)
    return []


def _update(machine: RosMachine, receiver: Value, call: Call) -> Value:
    node = as_node(machine, call.argument(0, 'node'))
    if node is None:
        return NONE
    group = group_of(machine, node, None, call.place)
    entity = add_entity(machine, node, EntityKind.TIMER, group, call.place)
    entity.library, entity.label = _UPDATER, 'update_diagnostics'
    period = call.argument(1, 'period')
    reason = Unknown('parameter diagnostic_updater.period (default 1.0)', call.place)
    entity.period = period or Mystery(reason)
    return NONE


def _duration(machine: RosMachine, instance: Instance) -> PlainState:
    return PlainState('duration', Const(0.0), place=instance.place)


def _set_duration(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    parts = [call.argument(None, 'seconds'), call.argument(None, 'nanoseconds')]
    given = [part.value if isinstance(part, Const) else part for part in parts if part is not None]
    if not all(isinstance(number, (int, float)) and abs(number) < _LONGEST for number in given):
        mystery = next((part for part in parts if isinstance(part, Mystery)), None)
        receiver.state.key = mystery or machine.mystery('an odd duration', call.place)
        return NONE
    seconds, nanoseconds = (part.value if isinstance(part, Const) else 0 for part in parts)
    receiver.state.key = Const(float(seconds + nanoseconds / 1e9))
    return NONE


def _look_up(name: str, position: int) -> Handler:
    """
    A method of the transform buffer; ``position`` is that of its timeout.

    What ``can_transform`` has found there is looked up at once.
    """

    def look_up(machine: RosMachine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(position, 'timeout')
        state = timeout.state if isinstance(timeout, Instance) else None
        seconds = state.key if isinstance(state, PlainState) else timeout
        asked = (_question(receiver, call), path_facts.Word.SET)
        is_there = name != 'can_transform' and asked in machine.world.ready
        _note_asked(machine.world, receiver)
        if seconds is not None and seconds != Const(0.0) and not is_there:
            machine.note_blocking(f'Buffer.{name}', receiver, seconds, call.place)
        if name == 'can_transform':
            return path_facts.known_if_true(asked, call)
        return machine.mystery('a transform at run time', call.place)

    return look_up


def _note_asked(world: RosWorld, buffer: Value) -> None:
    """What the buffer knows comes by the subscriptions of its listener."""
    state = buffer.state if isinstance(buffer, Instance) else None
    listener = state.of if isinstance(state, PlainState) else None
    brings = listener.state if isinstance(listener, Instance) else None
    if isinstance(brings, EntityState) and brings not in world.asked_messages:
        world.asked_messages.append(brings)


def _question(buffer: Value, call: Call) -> Value:
    """Which transform of which time is asked for: equal for two that are the same for certain."""
    names = ('target_frame', 'source_frame', 'time')
    asked = (call.argument(at, name) for at, name in enumerate(names))
    return Const((buffer, *map(_identity, asked)))


def _identity(value: Value | None) -> object:
    if isinstance(value, Mystery):
        return _LATEST if value.text == _LATEST else (value.unknown, value.text)
    return value if isinstance(value, (Const, Instance)) else object()


def _time(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """A time; without arguments it is 0, which stands for the latest transform there is."""
    is_latest = not (call.args or call.keywords or call.more)
    text = _LATEST if is_latest else 'rclpy.time.Time(…)'
    return machine.mystery('result of rclpy.time.Time, which is not scanned', call.place, text)


_LOOK_UPS = {
    'lookup_transform': 3,
    'lookup_transform_full': 5,
    'can_transform': 3,
    'can_transform_full': 5,
    'transform': 2,
    'transform_full': 4,
}

_SYNCHRONIZER = LibraryClass(
    state=_filter_state, init=_synchronize, methods={'registerCallback': _register}
)

TABLE = Library(
    classes={
        _TF: LibraryClass(init=_listen),
        'tf2_ros.Buffer': LibraryClass(
            state=lambda machine, instance: PlainState('tf_buffer', place=instance.place),
            init=lambda machine, receiver, call: NONE,
            methods={name: _look_up(name, at) for name, at in _LOOK_UPS.items()},
        ),
        'rclpy.duration.Duration': LibraryClass(state=_duration, init=_set_duration),
        'message_filters.Subscriber': LibraryClass(
            init=_subscribe,
            methods={'registerCallback': _register},
            properties={'sub': _subscription},
        ),
        'message_filters.TimeSynchronizer': _SYNCHRONIZER,
        'message_filters.ApproximateTimeSynchronizer': _SYNCHRONIZER,
        'message_filters.Cache': LibraryClass(
            state=_filter_state, init=_cache, methods={'registerCallback': _register}
        ),
        'diagnostic_updater.Updater': LibraryClass(init=_update),
    },
    functions={'rclpy.time.Time': _time},
    aliases={
        'tf2_ros.transform_listener.TransformListener': _TF,
        'tf2_ros.buffer.Buffer': 'tf2_ros.Buffer',
        'rclpy.time.Duration': 'rclpy.duration.Duration',
        'diagnostic_updater._diagnostic_updater.Updater': 'diagnostic_updater.Updater',
    },
)
