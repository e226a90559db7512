"""
Action servers and clients.

Source: rclpy 7.1.6, ``action/server.py`` (goal, cancel and handle-accepted callbacks run in
the waitable and hence in its group; ``notify_execute`` makes a task, which is in no group)
and ``action/client.py``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.made_entities import (
    entity_made_before,
    remember_entity,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.libraries.rclpy.tables.clients import note_presence
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import as_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import add_entity, mark_destroyed
from ros2cc_extract.extract.static.libraries.rclpy.tables.tasks import groupless
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Handler,
    Instance,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind

SERVER = 'rclpy.action.server.ActionServer'
CLIENT = 'rclpy.action.client.ActionClient'

_SERVER_CALLBACKS = ('goal_callback', 'cancel_callback', 'handle_accepted_callback')


def _init_server(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    node = _node(machine, call)
    if node is None:
        return NONE
    place = call.place
    group = group_of(machine, node, call.argument(None, 'callback_group'), place)
    key = call.argument(2, 'action_name')
    if _is_made_again(machine, receiver, node, EntityKind.ACTION_SERVER, key, place):
        return NONE
    server = add_entity(machine, node, EntityKind.ACTION_SERVER, group, place)
    server.key, server.goal_callback = key, call.argument(None, 'goal_callback')
    server.type = call.argument(1, 'action_type')
    found = (call.argument(None, name) for name in _SERVER_CALLBACKS)
    server.extra_callbacks = tuple(value for value in found if value is not None)
    server.defers = call.argument(None, _SERVER_CALLBACKS[-1]) is not None
    receiver.state = server
    remember_entity(machine, receiver)
    execute = add_entity(machine, node, EntityKind.ACTION_EXECUTE, groupless(machine), place)
    execute.key = server.key
    execute.callback = call.argument(3, 'execute_callback')
    return NONE


def _init_client(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    node = _node(machine, call)
    if node is None:
        return NONE
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    key = call.argument(2, 'action_name')
    if _is_made_again(machine, receiver, node, EntityKind.ACTION_CLIENT, key, call.place):
        return NONE
    client = add_entity(machine, node, EntityKind.ACTION_CLIENT, group, call.place)
    client.key = key
    client.type = call.argument(1, 'action_type')
    receiver.state = client
    remember_entity(machine, receiver)
    return NONE


def _is_made_again(
    machine: RosMachine,
    receiver: Instance,
    node: Instance,
    kind: EntityKind,
    key: Value | None,
    place: Place,
) -> bool:
    """Whether ``receiver`` stands for what callbacks have made here before."""
    known = entity_made_before(machine, node, kind, key, place)
    if known is not None:
        receiver.state = known.state
    return known is not None


def _node(machine: RosMachine, call: Call) -> Instance | None:
    options = options_of(call.argument(0, 'node') or NONE)
    return next((node for node in (as_node(machine, o) for o in options) if node), None)


def _send_goal(machine: RosMachine, receiver: Value, call: Call) -> Value:
    machine.note_blocking('send_goal', receiver, None, call.place)
    return machine.mystery('result of send_goal', call.place, 'send_goal')


def _send_goal_async(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """The feedback callback runs in the client's waitable, so in its group."""
    assert isinstance(receiver, Instance)
    feedback = call.argument(1, 'feedback_callback')
    if (
        isinstance(receiver.state, EntityState)
        and feedback is not None
        and feedback != NONE
        and feedback not in receiver.state.extra_callbacks
    ):
        receiver.state.extra_callbacks += (feedback,)
    return machine.future(call.place, 'goal', receiver)


def _wait_for_server(machine: RosMachine, receiver: Value, call: Call) -> Value:
    note_presence(machine, 'wait_for_server', receiver, call)
    return machine.mystery('result of wait_for_server', call.place, 'wait_for_server')


def _destroy(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance) and isinstance(receiver.state, EntityState):
        mark_destroyed(machine, receiver.state, call.place)
    return NONE


_CLIENT_METHODS: dict[str, Handler] = {
    'send_goal': _send_goal,
    'send_goal_async': _send_goal_async,
    'wait_for_server': _wait_for_server,
    'destroy': _destroy,
}


def _late_callback(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance) and isinstance(receiver.state, EntityState) and call.args:
        receiver.state.extra_callbacks += (call.args[0],)
    return NONE


TABLE = Library(
    classes={
        SERVER: LibraryClass(
            init=_init_server,
            methods={
                'destroy': _destroy,
                'register_goal_callback': _late_callback,
                'register_cancel_callback': _late_callback,
                'register_handle_accepted_callback': _late_callback,
            },
        ),
        CLIENT: LibraryClass(init=_init_client, methods=_CLIENT_METHODS),
    },
    aliases={'rclpy.action.ActionServer': SERVER, 'rclpy.action.ActionClient': CLIENT},
)
