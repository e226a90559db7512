"""
Libraries that make entities on a node's behalf.

Sources (Jazzy): ``tf2_ros/transform_listener.py`` (two subscriptions in a reentrant group of
its own; ``spin_thread`` adds a single-threaded executor), ``message_filters/__init__.py``
(one subscription each), ``diagnostic_updater/_diagnostic_updater.py`` (one timer).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.machine import Machine
from ros2cc_extract.extract.static.ros_executors import (
    SINGLE,
    add_node,
    as_node,
    record_spin,
)
from ros2cc_extract.extract.static.ros_groups import group_of, new_group
from ros2cc_extract.extract.static.ros_nodes import add_entity
from ros2cc_extract.extract.static.values import (
    NONE,
    Call,
    Const,
    Instance,
    Mystery,
    Sequence,
    Value,
)
from ros2cc_extract.extract.static.values import Library as Name
from ros2cc_extract.extract.static.world import (
    EntityState,
    ExecutorState,
    GroupState,
    PlainState,
)
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.model import EntityKind, GroupType

_TF = 'tf2_ros.TransformListener'
_FILTERS = 'message_filters'
_UPDATER = 'diagnostic_updater.Updater'


def _listen(machine: Machine, receiver: Value, call: Call) -> Value:
    node = as_node(machine, call.argument(1, 'node'))
    if node is None:
        return NONE
    state = GroupState(type=GroupType.REENTRANT, library=_TF)
    group = new_group(machine, state, call.place, 'tf')
    for topic, label in (('/tf', 'tf_callback'), ('/tf_static', 'tf_static_callback')):
        entity = add_entity(machine, node, EntityKind.SUBSCRIPTION, group, call.place)
        entity.key, entity.label, entity.library = Const(topic), label, _TF
    if machine.truth(call.argument(2, 'spin_thread') or Const(False)):
        _spin_thread(machine, node, call)
    return NONE


def _spin_thread(machine: Machine, node: Instance, call: Call) -> None:
    executor = Instance(Name(SINGLE), call.place)
    executor.state = ExecutorState('SingleThreadedExecutor')
    executor.slots['__nodes__'] = ()
    executor.hint = 'tf_executor'
    machine.world.executors.append(executor)
    add_node(machine, executor, node)
    before = machine.world.in_thread
    machine.world.in_thread = True
    record_spin(machine, executor, 'spin', call.place, True)
    machine.world.in_thread = before


def _subscribe(machine: Machine, receiver: Value, call: Call) -> Value:
    """``Subscriber(node, type, topic, …)``; further arguments go to ``create_subscription``."""
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is None:
        return NONE
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    entity = add_entity(machine, node, EntityKind.SUBSCRIPTION, group, call.place)
    entity.key, entity.library = call.argument(2, 'topic'), _FILTERS
    entity.label = 'filter_input'
    receiver.state = entity
    return NONE


def _filter_state(machine: Machine, instance: Instance) -> PlainState:
    return PlainState('filter', place=instance.place)


def _synchronize(machine: Machine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    receiver.state = PlainState('filter', of=call.argument(0, 'fs', 'f'), place=call.place)
    return NONE


def _register(machine: Machine, receiver: Value, call: Call) -> Value:
    """Every input's subscription runs the user's function when its message is the last."""
    callback = call.argument(0, 'cb')
    for entity in _inputs(receiver):
        if callback is not None:
            entity.callback = entity.callback or callback
    return machine.mystery('a filter connection', call.place)


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


def _update(machine: Machine, receiver: Value, call: Call) -> Value:
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


_SYNCHRONIZER = LibraryClass(
    state=_filter_state, init=_synchronize, methods={'registerCallback': _register}
)

TABLE = Library(
    classes={
        _TF: LibraryClass(init=_listen),
        'message_filters.Subscriber': LibraryClass(
            init=_subscribe, methods={'registerCallback': _register}
        ),
        'message_filters.TimeSynchronizer': _SYNCHRONIZER,
        'message_filters.ApproximateTimeSynchronizer': _SYNCHRONIZER,
        'message_filters.Cache': _SYNCHRONIZER,
        'diagnostic_updater.Updater': LibraryClass(init=_update),
    },
    aliases={
        'tf2_ros.transform_listener.TransformListener': _TF,
        'diagnostic_updater._diagnostic_updater.Updater': 'diagnostic_updater.Updater',
    },
)
