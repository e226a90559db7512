"""
Functions of the program that rclpy's own services call: transitions and parameter callbacks.

Sources (rclpy 7.1.6 and 9.1.2): ``lifecycle/node.py`` (the ``change_state`` service runs the
transitions of a node, ``trigger_…`` runs one in its caller), ``node.py`` (``set_parameters``,
``set_parameters_atomically`` and ``declare_parameter`` run the parameter callbacks in their
caller, the latest first), ``parameter_service.py`` (two services of the default group do so).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import NodeState
from ros2cc_extract.extract.static.libraries.rclpy.tables.builtin_entities import (
    list_clock,
    option_of_node,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import items_of, start_sim_time
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    LIFECYCLE_NODE,
    NODE,
    NODE_METHODS,
    add_entity,
    init_node,
)
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Bound,
    Call,
    Function,
    Handler,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import EntityKind

TRANSITIONS = (
    'on_configure',
    'on_activate',
    'on_deactivate',
    'on_cleanup',
    'on_shutdown',
    'on_error',
)
"""In the order in which a node goes through them."""

BUILDING = frozenset({'on_configure', 'on_activate'})
"""What others rest on: attributes that they set are set when the node is at work."""

_CHANGED, _DECLARED = ('pre', 'on', 'post'), ('on', 'post')


def init_life_cycle_node(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``LifecycleNode.__init__``: as that of a node, and one more service."""
    init_node(machine, receiver, call)
    is_served = option_of_node(machine, 'enable_communication_interface', call, default=True)
    if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState) and is_served:
        _add_transitions(machine, receiver, call)
    return NONE


def _add_transitions(machine: RosMachine, node: Instance, call: Call) -> None:
    """One entity for each transition that the program has written; one service runs them all."""
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    for name in TRANSITIONS:
        method = machine.attribute(node, name, call.place)
        if isinstance(method, Bound) and isinstance(method.function, Function):
            entity = add_entity(machine, node, EntityKind.LIFECYCLE_SERVICE, group, call.place)
            entity.callback = method


def _trigger(name: str) -> Handler:
    """A transition that the program asks for itself runs where it asks."""

    def trigger(machine: RosMachine, receiver: Value, call: Call) -> Value:
        method = machine.attribute(receiver, name, call.place)
        if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
            receiver.state.changes_own_state = True
        if isinstance(method, Bound):
            before = Mystery(Unknown('state of the node at run time', call.place), 'state')
            machine.call(method, Call(call.place, [before]))
        return machine.mystery(f'result of {name}', call.place)

    return trigger


def _add_parameter_callback(stage: str) -> Handler:
    """A function that is called when parameters are set, by a service or by the program."""

    def add(machine: RosMachine, receiver: Value, call: Call) -> Value:
        callback = call.argument(0, 'callback')
        if not isinstance(receiver, Instance) or callback is None:
            return NONE
        state = receiver.state
        known = state.parameter_callbacks.setdefault(stage, [])
        if callback not in known:
            known.insert(0, callback)
        if state.has_parameter_services and not _is_served(machine, receiver, callback):
            group = group_of(machine, receiver, None, call.place)
            entity = add_entity(machine, receiver, EntityKind.PARAMETER_SERVICE, group, call.place)
            entity.callback = callback
        return NONE

    return add


def _is_served(machine: RosMachine, node: Instance, callback: Value) -> bool:
    return any(
        entity.kind is EntityKind.PARAMETER_SERVICE and entity.callback == callback
        for entity in machine.world.by_node.get(id(node), ())
    )


def _remove_parameter_callback(stage: str) -> Handler:
    def remove(machine: RosMachine, receiver: Value, call: Call) -> Value:
        callback = call.argument(0, 'callback')
        if isinstance(receiver, Instance) and not machine.world.path:
            known = receiver.state.parameter_callbacks.get(stage, [])
            known[:] = [each for each in known if each != callback]
        return NONE

    return remove


def _setting(name: str, stages: tuple[str, ...]) -> Handler:
    """A method of the node that sets parameters, and runs the callbacks of these stages."""
    original = NODE_METHODS.get(name)

    def set_parameters(machine: RosMachine, receiver: Value, call: Call) -> Value:
        if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
            given = items_of(call.argument(0, 'parameter_list'))
            list_clock(machine, start_sim_time(machine, receiver, given, call.place))
            _run_parameter_callbacks(machine, receiver.state, stages, call.place)
        if original is not None:
            return original(machine, receiver, call)
        return machine.mystery(f'result of {name}', call.place, name)

    return set_parameters


def _run_parameter_callbacks(
    machine: RosMachine, state: NodeState, stages: tuple[str, ...], place: Place
) -> None:
    for stage in stages:
        for callback in tuple(state.parameter_callbacks.get(stage, ())):
            given = Mystery(Unknown('parameters that are set at run time', place), 'parameters')

            def run(option: Value, given: Mystery = given) -> Value:
                return machine.call(option, Call(place, [given]))

            machine.each(callback, run, place)


_STAGES = {'pre': 'pre_set', 'on': 'on_set', 'post': 'post_set'}

TABLE = Library(
    classes={
        LIFECYCLE_NODE: LibraryClass(
            init=init_life_cycle_node,
            bases=(NODE,),
            methods={
                f'trigger_{name.removeprefix("on_")}': _trigger(name)
                for name in TRANSITIONS
                if name != 'on_error'
            },
        ),
    },
    added_methods={
        NODE: {
            **{
                f'add_{name}_parameters_callback': _add_parameter_callback(stage)
                for stage, name in _STAGES.items()
            },
            **{
                f'remove_{name}_parameters_callback': _remove_parameter_callback(stage)
                for stage, name in _STAGES.items()
            },
            'set_parameters': _setting('set_parameters', _CHANGED),
            'set_parameters_atomically': _setting('set_parameters_atomically', _CHANGED),
            'declare_parameter': _setting('declare_parameter', _DECLARED),
            'declare_parameters': _setting('declare_parameters', _DECLARED),
        },
    },
)
