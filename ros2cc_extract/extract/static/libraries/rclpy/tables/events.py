"""
Callbacks that hang on something else: QoS events, parameter changes.

Sources (rclpy 7.1.6): ``event_handler.py`` (each callback that is given makes one waitable in
the group of its publisher or subscription), ``parameter_event_handler.py`` (one subscription).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.libraries.rclpy.tables.builtin_entities import (
    without_default_events,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import as_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    NODE,
    NODE_METHODS,
    add_callback,
    add_entity,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Value,
)
from ros2cc_extract.spec.model import EntityKind

_HANDLER = 'rclpy.ParameterEventHandler'
_NO_CALLBACKS = frozenset({'use_default_callbacks'})


def _keep_callbacks(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``SubscriptionEventCallbacks(deadline=…)``: keep what is given by keyword."""
    assert isinstance(receiver, Instance)
    given: dict[Value, Value] = {
        Const(name): value for name, value in call.keywords.items() if name not in _NO_CALLBACKS
    }
    default = call.argument(None, 'use_default_callbacks')
    receiver.state = PlainState('event callbacks', default, Mapping(given), call.place)
    return NONE


def with_events(original: Handler, key_index: int) -> Handler:
    """A create call whose ``event_callbacks`` make entities of their own."""

    def create(machine: RosMachine, receiver: Value, call: Call) -> Value:
        before = len(machine.world.builtins)
        made = original(machine, receiver, call)
        events = call.argument(None, 'event_callbacks')
        if isinstance(receiver, Instance) and isinstance(events, Instance):
            without_default_events(machine, before, events)
            _add_events(machine, receiver, events, call, call.argument(key_index, 'topic'))
        return made

    return create


def _add_events(
    machine: RosMachine, node: Instance, events: Instance, call: Call, key: Value | None
) -> None:
    given = events.state.of if isinstance(events.state, PlainState) else None
    if not isinstance(given, Mapping):
        return
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    for callback in given.entries.values():
        if callback != NONE:
            entity = add_entity(machine, node, EntityKind.QOS_EVENT, group, call.place)
            entity.callback, entity.key = callback, key


def _listen(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is not None:
        group = group_of(machine, node, call.argument(2, 'callback_group'), call.place)
        entity = add_entity(machine, node, EntityKind.SUBSCRIPTION, group, call.place)
        entity.key, entity.library = Const('/parameter_events'), _HANDLER
        entity.label = 'on_parameter_event'
        receiver.state = entity
    return NONE


def _handle(index: int) -> Handler:
    def handler(machine: RosMachine, receiver: Value, call: Call) -> Value:
        callback = call.argument(index, 'callback')
        state = receiver.state if isinstance(receiver, Instance) else None
        if isinstance(state, EntityState) and callback is not None:
            add_callback(state, callback)
        return machine.mystery('a parameter callback handle', call.place)

    return handler


_WITH_EVENTS = ('create_subscription', 'create_publisher')

_CALLBACKS = LibraryClass(init=_keep_callbacks)

TABLE = Library(
    classes={
        'rclpy.event_handler.SubscriptionEventCallbacks': _CALLBACKS,
        'rclpy.event_handler.PublisherEventCallbacks': _CALLBACKS,
        'rclpy.parameter_event_handler.ParameterEventHandler': LibraryClass(
            init=_listen,
            methods={
                'add_parameter_callback': _handle(2),
                'add_parameter_event_callback': _handle(0),
            },
        ),
    },
    added_methods={
        NODE: {
            **{name: with_events(NODE_METHODS[name], 1) for name in _WITH_EVENTS},
        }
    },
    aliases={
        'rclpy.qos_event.SubscriptionEventCallbacks': (
            'rclpy.event_handler.SubscriptionEventCallbacks'
        ),
        'rclpy.qos_event.PublisherEventCallbacks': 'rclpy.event_handler.PublisherEventCallbacks',
    },
)
