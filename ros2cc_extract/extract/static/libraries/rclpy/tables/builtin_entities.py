"""
Entities that no user wrote: what rclpy makes for every node, publisher and subscription.

Sources: rclpy 7.1.6 and 9.1.2, ``node.py`` (which services, in which order),
``parameter_service.py``, ``logging_service.py``, ``type_description_service.py``,
``time_source.py``, ``lifecycle/node.py``, ``event_handler.py``; measured by the live tests.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import items_of, start_sim_time
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import group_of
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.containers import Mapping
from ros2cc_extract.extract.static.python.values.values import (
    Call,
    Const,
    Instance,
    Mystery,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import EntityKind

_PARAMETER = 'rclpy.parameter_service.ParameterService'
_PARAMETER_SERVICES = (
    'describe_parameters',
    'get_parameters',
    'get_parameter_types',
    'list_parameters',
    'set_parameters',
    'set_parameters_atomically',
)
_LOGGER_SERVICES = ('get_logger_levels', 'set_logger_levels')
_LOGGING = 'rclpy.logging_service.LoggingService'
_TYPE_DESCRIPTION = 'rclpy.type_description_service.TypeDescriptionService._service_callback'
_LIFECYCLE = 'rclpy.lifecycle.node.LifecycleNodeMixin'
_LIFECYCLE_SERVICES = (
    'change_state',
    'get_state',
    'get_available_states',
    'get_available_transitions',
    'get_transition_graph',
)
_DEFAULT_EVENTS = ('incompatible_qos', 'incompatible_type')


def add_builtins_of_node(machine: RosMachine, node: Instance, call: Call) -> None:
    """What ``Node.__init__`` makes, as far as the scan lists it; ``call`` is of that."""
    given = items_of(call.argument(None, 'parameter_overrides'))
    clock = start_sim_time(machine, node, given, call.place)
    if not machine.world.lists_builtin:
        return
    group = group_of(machine, node, None, call.place)
    _add_events(machine, node, group, call.place, 'Publisher')
    list_clock(machine, clock)
    for service, function in _services(machine, call):
        is_parameter = service in _PARAMETER_SERVICES
        kind = EntityKind.PARAMETER_SERVICE if is_parameter else EntityKind.SERVICE
        entity = _add(machine, node, kind, group, call.place)
        entity.key, entity.callback = _own_name(node, service, ''), Name(function)
    _add_lifecycle_services(machine, node, call)


def list_clock(machine: RosMachine, clock: EntityState | None) -> None:
    """List what a node that uses simulated time has made for it."""
    if clock is not None and machine.world.lists_builtin:
        machine.world.builtins.append(clock)
        _add_events(machine, clock.node, clock.group, clock.place, 'Subscription')


def _services(machine: RosMachine, call: Call) -> Iterator[tuple[str, str]]:
    if option_of_node(machine, 'start_parameter_services', call, default=True):
        yield from ((name, f'{_PARAMETER}._{name}_callback') for name in _PARAMETER_SERVICES)
    if option_of_node(machine, 'enable_logger_service', call, default=False):
        yield from ((name, f'{_LOGGING}._{name}') for name in _LOGGER_SERVICES)
    yield 'get_type_description', _TYPE_DESCRIPTION


def _add_lifecycle_services(machine: RosMachine, node: Instance, call: Call) -> None:
    if not node.state.lifecycle:
        return
    if not option_of_node(machine, 'enable_communication_interface', call, default=True):
        return
    group = group_of(machine, node, call.argument(None, 'callback_group'), call.place)
    for service in _LIFECYCLE_SERVICES:
        entity = _add(machine, node, EntityKind.LIFECYCLE_SERVICE, group, call.place)
        entity.key = _own_name(node, service, '/')
        entity.callback = Name(f'{_LIFECYCLE}.__on_{service}')


def _own_name(node: Instance, service: str, before: str) -> Value:
    name = node.state.name
    if isinstance(name, Const):
        return Const(f'{before}{name.value}/{service}')
    return Mystery(Unknown('name of the node', node.place), f'~/{service}')


def option_of_node(machine: RosMachine, name: str, call: Call, *, default: bool) -> bool:
    """An option of the node; one that could not be followed is taken to be the default."""
    given = call.argument(None, name)
    truth = machine.truth(given) if given is not None else None
    return default if truth is None else truth


def add_events_of(
    machine: RosMachine, node: Instance, group: Instance, place: Place, of: EntityState | None
) -> None:
    """The handlers that rclpy adds to a subscription, or to a publisher where ``of`` is none."""
    if machine.world.lists_builtin:
        kind = 'Publisher' if of is None else 'Subscription'
        _add_events(machine, node, group, place, kind, of)


def without_default_events(machine: RosMachine, before: int, events: Instance) -> None:
    """Take back what was added since ``before`` where ``events`` has functions of its own."""
    state = events.state
    if not isinstance(state, PlainState) or state.of is None:
        return
    entries = state.of.entries if isinstance(state.of, Mapping) else {}
    given = {key.value for key in entries if isinstance(key, Const)}
    none_at_all = state.key == Const(False)
    machine.world.builtins[before:] = [
        entity
        for entity in machine.world.builtins[before:]
        if not none_at_all and _event_of(entity) not in given
    ]


def _event_of(entity: EntityState) -> str | None:
    name = entity.callback.name if isinstance(entity.callback, Name) else ''
    return next((event for event in _DEFAULT_EVENTS if name.endswith(f'_{event}_callback')), None)


def _add_events(
    machine: RosMachine,
    node: Instance,
    group: Instance,
    place: Place,
    kind: str,
    of: EntityState | None = None,
) -> None:
    maker = f'rclpy.event_handler.{kind}EventCallbacks.create_event_handlers.<locals>'
    for event in _DEFAULT_EVENTS:
        entity = _add(machine, node, EntityKind.QOS_EVENT, group, place)
        entity.callback = Name(f'{maker}._default_{event}_callback')
        entity.label, entity.part_of = 'event', of


def _add(
    machine: RosMachine, node: Instance, kind: EntityKind, group: Instance, place: Place
) -> EntityState:
    world = machine.world
    entity = EntityState(kind, node, group, place, path=world.path, count=world.count)
    entity.when, entity.builtin = world.when, True
    entity.number = len(world.entities) + len(world.builtins)
    world.builtins.append(entity)
    return entity
