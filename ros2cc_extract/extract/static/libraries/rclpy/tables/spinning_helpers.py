"""
Helper libraries whose methods wait or spin inside, where their source is not scanned.

Sources: ``tf2_ros/buffer_client.py`` (one action client; a look-up sends a goal and waits for an
event), ``nav2_simple_commander/robot_navigator.py`` (a node of its own, which its methods spin),
``pymoveit2/moveit2.py`` 4.2 (its methods spin the given node), rclpy 7.1.6,
``parameter_client.py`` (clients of the given node, in the given group).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import NodeState
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import as_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import NODE, add_entity, init_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.spins import spin_in_passing
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import EntityKind

_BUFFER_CLIENT = 'tf2_ros.BufferClient'
_PARAMETER_CLIENT = 'rclpy.parameter_client.AsyncParameterClient'
_REQUESTS = (
    'get_parameters',
    'set_parameters',
    'set_parameters_atomically',
    'describe_parameters',
    'get_parameter_types',
    'list_parameters',
    'delete_parameters',
    'load_parameter_file',
)
_NAVIGATOR = 'nav2_simple_commander.robot_navigator.BasicNavigator'
_PATIENCE_S = 0.1
"""So long the navigator spins while it looks whether a task is complete."""
_MOVEIT = 'pymoveit2.MoveIt2'
_PADDING_S = 2.0
"""What a buffer client waits beyond the time-out it was given, unless another value is given."""


def _make_buffer_client(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is not None:
        group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
        entity = add_entity(machine, node, EntityKind.ACTION_CLIENT, group, call.place)
        entity.key, entity.library = call.argument(1, 'ns'), _BUFFER_CLIENT
        entity.label = 'buffer_client'
        receiver.state = entity
    return NONE


def _make_parameter_client(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """It makes six clients, all in one group; one of them stands for all."""
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is not None:
        group = group_of(machine, node, call.argument(3, 'callback_group'), call.place)
        entity = add_entity(machine, node, EntityKind.CLIENT, group, call.place)
        name = call.argument(1, 'remote_node_name')
        unknown = Unknown('parameters of a node that could not be followed', call.place)
        is_text = isinstance(name, Const) and isinstance(name.value, str)
        entity.key = Const(f'{name.value}/get_parameters') if is_text else Mystery(unknown)  # type: ignore[union-attr]
        entity.library, entity.label = _PARAMETER_CLIENT, 'parameter_client'
        receiver.state = entity
    return NONE


def _ask_for_parameters(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Each method sends a request; a callback that is given is one of the future."""
    future = machine.future(call.place, 'client', receiver)
    callback = call.argument(None, 'callback')
    if callback is not None and callback != NONE:
        add = machine.attribute(future, 'add_done_callback', call.place)
        machine.call(add, Call(call.place, [callback]))
    return future


def _wait_for_parameter_services(machine: RosMachine, receiver: Value, call: Call) -> Value:
    timeout = call.argument(0, 'timeout_sec')
    machine.note_blocking('wait_for_service', receiver, timeout, call.place)
    return machine.mystery('whether services are there', call.place, 'wait_for_services()')


def _ask(name: str, position: int) -> Handler:
    def ask(machine: RosMachine, receiver: Value, call: Call) -> Value:
        timeout = call.argument(position, 'timeout')
        state = timeout.state if isinstance(timeout, Instance) else None
        given = state.key if isinstance(state, PlainState) else timeout
        machine.note_blocking(f'BufferClient.{name}', receiver, _padded(given, call), call.place)
        return machine.mystery('a transform at run time', call.place)

    return ask


def _padded(given: Value | None, call: Call) -> Value:
    if given is None:
        return Const(_PADDING_S)
    if isinstance(given, Const) and isinstance(given.value, (int, float)):
        return Const(given.value + _PADDING_S)
    return Mystery(Unknown('a duration that could not be followed', call.place))


def _make_navigator(machine: RosMachine, receiver: Value, call: Call) -> Value:
    name = call.argument(0, 'node_name') or Const('basic_navigator')
    return init_node(machine, receiver, Call(call.place, [name]))


def _spin_navigator(machine: RosMachine, receiver: Value, call: Call) -> Value:
    spin_in_passing(machine, receiver, 'spin_until_future_complete', call.place)
    return machine.mystery('answer of the navigation', call.place)


def _ask_navigator(machine: RosMachine, receiver: Value, call: Call) -> Value:
    how = 'spin_until_future_complete'
    machine.world.asked_outside.add(call.place)
    spin_in_passing(machine, receiver, how, call.place, Const(_PATIENCE_S))
    return machine.mystery('whether the navigation is over', call.place)


def _make_moveit(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    node = as_node(machine, call.argument(0, 'node'))
    if node is not None and isinstance(node.state, NodeState):
        receiver.slots['_node'] = node
        reason = f'the node is passed to {_MOVEIT}, which is not scanned'
        node.state.more.append((reason, call.place))
    return NONE


def _spin_moveit(machine: RosMachine, receiver: Value, call: Call) -> Value:
    node = receiver.slots.get('_node') if isinstance(receiver, Instance) else None
    if isinstance(node, Instance):
        spin_in_passing(machine, node, 'spin_once', call.place)
    return machine.mystery('result of a motion', call.place)


_NAVIGATE = [
    'assistedTeleop',
    'backup',
    'cancelTask',
    'changeMap',
    'clearAllCostmaps',
    'clearCostmapAroundRobot',
    'clearCostmapExceptRegion',
    'clearGlobalCostmap',
    'clearLocalCostmap',
    'dockRobotByID',
    'dockRobotByPose',
    'driveOnHeading',
    'followGpsWaypoints',
    'followPath',
    'followWaypoints',
    'getGlobalCostmap',
    'getLocalCostmap',
    'getPath',
    'getPathThroughPoses',
    'goThroughPoses',
    'goToPose',
    'lifecycleShutdown',
    'lifecycleStartup',
    'smoothPath',
    'spin',
    'undockRobot',
    'waitUntilNav2Active',
]
_MOVE = ('compute_fk', 'compute_ik', 'plan', 'update_planning_scene', 'wait_until_executed')

TABLE = Library(
    classes={
        _BUFFER_CLIENT: LibraryClass(
            init=_make_buffer_client,
            methods={
                'lookup_transform': _ask('lookup_transform', 3),
                'lookup_transform_full': _ask('lookup_transform_full', 5),
                'can_transform': _ask('can_transform', 3),
                'can_transform_full': _ask('can_transform_full', 5),
            },
        ),
        _PARAMETER_CLIENT: LibraryClass(
            init=_make_parameter_client,
            methods={
                **dict.fromkeys(_REQUESTS, _ask_for_parameters),
                'wait_for_services': _wait_for_parameter_services,
            },
        ),
        _NAVIGATOR: LibraryClass(
            init=_make_navigator,
            bases=(NODE,),
            methods={
                **dict.fromkeys(_NAVIGATE, _spin_navigator),
                'isTaskComplete': _ask_navigator,
            },
        ),
        _MOVEIT: LibraryClass(init=_make_moveit, methods=dict.fromkeys(_MOVE, _spin_moveit)),
    },
    aliases={
        'tf2_ros.buffer_client.BufferClient': _BUFFER_CLIENT,
        'nav2_simple_commander.BasicNavigator': _NAVIGATOR,
        'pymoveit2.moveit2.MoveIt2': _MOVEIT,
    },
)
