"""
Nodes and what they create.

Positions and names of arguments: rclpy 7.1.6, ``node.py``. Only ``create_timer`` (third) and
``create_guard_condition`` (second) take the group as a positional argument.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import (
    note_begun,
    note_made,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.assumptions import AT_RUN_TIME
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    DESTROY,
    DESTROY_PUBLISHER,
    OF_RATE,
    note_end,
    note_node_ended,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.made_entities import (
    entity_made_before,
    remember_entity,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    GroupState,
    NodeState,
    PublisherState,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.builtin_entities import (
    add_builtins_of_node,
    add_events_of,
    option_of_node,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import clock_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import (
    DEFAULT_GROUP,
    default_group_of,
    group_of,
    new_group,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.shutdown import context_of_node
from ros2cc_extract.extract.static.libraries.rclpy.values.parameters import PARAMETER_METHODS
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.machine.machine import PAIR_STEPS, THING_STEPS
from ros2cc_extract.extract.static.python.objects.allocation_sites import (
    made_before,
    remember,
)
from ros2cc_extract.extract.static.python.values.assumed_defaults import by_default, default_of
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Choice,
    Const,
    Handler,
    Instance,
    Mystery,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import EntityKind, GroupType

NODE = 'rclpy.node.Node'
_OWN_ARGUMENTS = ('use_global_arguments', 'cli_args', 'context')
_UNDECLARED = (
    'allow_undeclared_parameters',
    'automatically_declare_parameters_from_overrides',
    'parameter_overrides',
    *_OWN_ARGUMENTS,
)

_BEGUN = '__begun__'
LIFECYCLE_NODE = 'rclpy.lifecycle.node.LifecycleNode'


@dataclass(frozen=True)
class CreateCall:
    """One ``create_…`` method: positions of its arguments, and their names."""

    kind: EntityKind
    cls: str
    key: tuple[int, str] | None = None
    callback: tuple[int, str] | None = None
    period: tuple[int, str] | None = None
    type: tuple[int, str] | None = None
    qos: tuple[int | None, str] | None = None
    group_position: int | None = None


CREATE_CALLS = {
    'create_subscription': CreateCall(
        EntityKind.SUBSCRIPTION,
        'rclpy.subscription.Subscription',
        (1, 'topic'),
        (2, 'callback'),
        type=(0, 'msg_type'),
        qos=(3, 'qos_profile'),
    ),
    'create_timer': CreateCall(
        EntityKind.TIMER,
        'rclpy.timer.Timer',
        callback=(1, 'callback'),
        period=(0, 'timer_period_sec'),
        group_position=2,
    ),
    'create_service': CreateCall(
        EntityKind.SERVICE,
        'rclpy.service.Service',
        (1, 'srv_name'),
        (2, 'callback'),
        type=(0, 'srv_type'),
        qos=(None, 'qos_profile'),
    ),
    'create_client': CreateCall(
        EntityKind.CLIENT,
        'rclpy.client.Client',
        (1, 'srv_name'),
        type=(0, 'srv_type'),
        qos=(None, 'qos_profile'),
    ),
    'create_guard_condition': CreateCall(
        EntityKind.GUARD_CONDITION,
        'rclpy.guard_condition.GuardCondition',
        callback=(0, 'callback'),
        group_position=1,
    ),
}


def make_node(machine: RosMachine, instance: Instance) -> NodeState:
    """The state of a new node, with its default group."""
    group = new_group(machine, GroupState(default=True), instance.place, None)
    state = NodeState(default_group=group, count=machine.world.count)
    names = {cls.name for cls in instance.mro if isinstance(cls, Name)}
    state.lifecycle = LIFECYCLE_NODE in names
    group.state.node = instance
    group.state.count = machine.world.count
    machine.world.nodes.append(instance)
    return state


def ghost_node(machine: RosMachine, value: Mystery) -> Instance:
    """The node that a value which cannot be followed must be; one for each such value."""
    value = machine.world.same_unknowns.get(value.unknown, value)
    key = f'{value.text}|{value.unknown.at}|{value.unknown.reason}'
    known = machine.world.ghosts.get(key)
    if known is None:
        known = Instance(Name(NODE), value.unknown.at or Place(''))
        state = make_node(machine, known)
        label = f'{value.text}: ' if value.text else ''
        state.ghost = Unknown(f'{label}{value.unknown.reason}', value.unknown.at)
        known.state = state
        known.hint = value.text.rpartition('.')[2] or None
        machine.world.ghosts[key] = known
    return known


def add_entity(
    machine: RosMachine, node: Instance, kind: EntityKind, group: Instance, place: Place
) -> EntityState:
    """Record an entity of ``node`` made here and now."""
    world = machine.world
    machine.charge(THING_STEPS + PAIR_STEPS * len(world.entities))
    entity = EntityState(kind, node, group, place, path=world.path, count=world.count)
    entity.assumed = world.assumed
    entity.when = world.when
    entity.after = len(world.set_up)
    entity.maker = world.activity or world.current
    entity.number = len(world.entities) + len(world.builtins)
    world.entities.append(entity)
    world.by_node.setdefault(id(node), []).append(entity)
    if kind is EntityKind.SUBSCRIPTION:
        add_events_of(machine, node, group, place, entity)
    note_made(world, kind.value, place)
    return entity


def init_node(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    if isinstance(receiver.state, NodeState):
        _note_begun_again(machine, receiver, call)
        state = receiver.state
        state.name = call.argument(0, 'node_name') or NONE
        _note_arguments(state, call)
        state.has_parameter_services = option_of_node(
            machine, 'start_parameter_services', call, default=True
        )
        machine.store.remove(receiver, DEFAULT_GROUP)
        add_builtins_of_node(machine, receiver, call)
    return NONE


def _note_arguments(state: NodeState, call: Call) -> None:
    """Its namespace, and what keeps the arguments of its process from it."""
    state.namespace = call.argument(None, 'namespace')
    state.has_own_arguments = any(map(call.keywords.__contains__, _OWN_ARGUMENTS))
    state.takes_any_parameter = any(map(call.keywords.__contains__, _UNDECLARED))


def _note_begun_again(machine: RosMachine, node: Instance, call: Call) -> None:
    """
    A singleton whose ``__init__`` runs each time its class is called begins its node anew.

    The executor no longer serves what was made before (rclpy 7.1.6, ``node.py``: the lists of
    entities and the default group are made anew).
    """
    state = node.state
    if _BEGUN in node.slots and state.begun == call.place:
        state.more.append(('its constructor runs again on the same object', call.place))
    state.begun = call.place
    machine.store.write(node, _BEGUN, NONE)


def _creator(row: CreateCall) -> Handler:
    def create(machine: RosMachine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Instance)
        group = group_of(
            machine, receiver, call.argument(row.group_position, 'callback_group'), call.place
        )
        key = call.argument(*row.key) if row.key else None
        callback = call.argument(*row.callback) if row.callback else None
        note_begun(machine.world, call.place)
        known = entity_made_before(machine, receiver, row.kind, key, call.place, callback)
        if known is not None:
            return known
        entity = add_entity(machine, receiver, row.kind, group, call.place)
        entity.key = key
        entity.callback = callback
        entity.period = call.argument(*row.period) if row.period else None
        entity.type = call.argument(*row.type) if row.type else None
        entity.qos = call.argument(*row.qos) if row.qos else None
        if call.argument(None, 'autostart') == Const(False):
            entity.dormant = call.place
        made = Instance(Name(row.cls), call.place)
        made.state = entity
        remember_entity(machine, made)
        return made

    return create


def _create_rate(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """A timer in a private reentrant group of the node (``node.py``, ``_rate_group``)."""
    assert isinstance(receiver, Instance)
    state = receiver.state
    known = entity_made_before(machine, receiver, EntityKind.TIMER, None, call.place)
    if known is not None:
        return known
    if state.rate_group is None:
        group = GroupState(type=GroupType.REENTRANT, library=OF_RATE, node=receiver)
        state.rate_group = new_group(machine, group, call.place, 'rate_group')
    entity = add_entity(machine, receiver, EntityKind.TIMER, state.rate_group, call.place)
    entity.library = OF_RATE
    frequency = call.argument(0, 'frequency')
    entity.period = _inverse(frequency) if frequency is not None else None
    made = Instance(Name('rclpy.timer.Rate'), call.place)
    made.state = entity
    remember_entity(machine, made)
    return made


def _inverse(frequency: Value) -> Value | None:
    """The period of a rate; what is open stays so, with what it is by default."""
    if isinstance(frequency, Mystery):
        return Mystery(frequency.unknown, frequency.text, by_default([frequency], _inverse))
    if isinstance(frequency, Choice):
        periods = [_inverse(each) for each in options_of(frequency)]
        return choice([period for period in periods if period is not None]) or None
    hertz = frequency.value if isinstance(frequency, Const) else None
    is_usual = isinstance(hertz, (int, float)) and _LEAST_HZ <= abs(hertz) <= _MOST_HZ
    return Const(1.0 / hertz) if is_usual and isinstance(hertz, (int, float)) else None


_LEAST_HZ, _MOST_HZ = 1e-12, 1e12
"""Of a rate whose period is a number to count with."""


def _create_publisher(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        given = call.argument(None, 'callback_group')
        group = group_of(machine, receiver, given, call.place)
        add_events_of(machine, receiver, group, call.place, None)
        _note_publisher(machine, receiver, call)
    made = Instance(Name('rclpy.publisher.Publisher'), call.place)
    made.state = PlainState('publisher', call.argument(1, 'topic'), receiver, call.place)
    return made


def _note_publisher(machine: RosMachine, node: Instance, call: Call) -> None:
    topic = call.argument(1, 'topic')
    text = topic.value if isinstance(topic, Const) else None
    publisher = PublisherState(
        node,
        topic,
        call.argument(0, 'msg_type'),
        call.argument(2, 'qos_profile'),
        call.place,
        machine.world.path,
    )
    machine.world.publishers.setdefault((id(node), call.place, text), publisher)


def _create_node(machine: RosMachine, receiver: Value, call: Call) -> Value:
    cls = Name(NODE)
    known = made_before(machine, cls, call)
    if known is not None:
        return known
    node = Instance(cls, call.place)
    node.path = machine.world.path
    node.state = make_node(machine, node)
    remember(machine, node, call)
    node.state.name = call.argument(0, 'node_name')
    _note_arguments(node.state, call)
    add_builtins_of_node(machine, node, call)
    machine.world.instances.append(node)
    return node


def _destroy(machine: RosMachine, receiver: Value, call: Call) -> Value:
    target = call.args[0] if call.args else None
    if isinstance(target, Instance) and isinstance(target.state, EntityState):
        mark_destroyed(machine, target.state, call.place)
    return Const(True)


def _destroy_publisher(machine: RosMachine, receiver: Value, call: Call) -> Value:
    for target in options_of(call.args[0]) if call.args else ():
        if isinstance(target, Instance) and isinstance(target.state, PlainState):
            note_end(machine, DESTROY_PUBLISHER, target, call.place)
    return Const(True)


def _destroy_node(machine: RosMachine, receiver: Value, call: Call) -> Value:
    if isinstance(receiver, Instance):
        note_node_ended(machine, receiver, call.place)
    return NONE


def add_callback(entity: EntityState, callback: Value) -> None:
    """One more function that an entity runs; the first gives it its name."""
    if entity.callback is None:
        entity.callback = callback
    elif callback not in (entity.callback, *entity.extra_callbacks):
        entity.extra_callbacks += (callback,)


def mark_destroyed(machine: RosMachine, entity: EntityState, place: Place) -> None:
    """Note that the program destroys ``entity`` while its node is alive."""
    note_end(machine, DESTROY, entity, place)
    if not machine.world.after_spin and not machine.world.shutting_down:
        entity.destroyed = True


def _default_group(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    return default_group_of(receiver)


def _unfollowed(reason: str) -> Handler:
    def handler(machine: RosMachine, receiver: Value, call: Call) -> Value:
        return machine.mystery(reason, call.place, reason)

    return handler


def _name_of(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``get_name()``: the name in the source, unless the node is renamed when it is started."""
    state = receiver.state if isinstance(receiver, Instance) else None
    name = state.name if isinstance(state, NodeState) else None
    return Mystery(Unknown(AT_RUN_TIME, call.place), AT_RUN_TIME, default_of(name))


NODE_METHODS: dict[str, Handler] = {
    **{name: _creator(row) for name, row in CREATE_CALLS.items()},
    'create_rate': _create_rate,
    'create_publisher': _create_publisher,
    'create_lifecycle_publisher': _create_publisher,
    'destroy_publisher': _destroy_publisher,
    'destroy_timer': _destroy,
    'destroy_rate': _destroy,
    'destroy_subscription': _destroy,
    'destroy_service': _destroy,
    'destroy_client': _destroy,
    'destroy_guard_condition': _destroy,
    **PARAMETER_METHODS,
    'get_clock': clock_of,
    'get_name': _name_of,
    'get_logger': _unfollowed('the logger'),
    'get_namespace': _unfollowed('namespace of the node at run time'),
    'destroy_node': _destroy_node,
}

_NAMES = frozenset(
    {
        *('clients', 'context', 'default_callback_group', 'executor', 'guards', 'handle'),
        *('publishers', 'services', 'subscriptions', 'timers', 'waitables', 'ParameterInput'),
        *('PARAM_REL_TOL', 'logger', 'name', 'namespace', 'clock'),
    }
)
_VERBS = frozenset(
    {
        *('add', 'count', 'create', 'declare', 'describe', 'destroy', 'get', 'has', 'is', 'list'),
        *('on', 'register', 'remove', 'resolve', 'set', 'spin', 'try', 'undeclare', 'use', 'wait'),
    }
)


def _may_have(name: str) -> bool:
    """
    Whether a node has such an attribute by itself, on some release.

    Source: rclpy 7.1.6 and 9.1.2, ``node.py``; a later one may have more methods.
    """
    return name.startswith('_') or name in _NAMES or name.partition('_')[0] in _VERBS


TABLE = Library(
    classes={
        NODE: LibraryClass(
            state=make_node,
            init=init_node,
            methods=NODE_METHODS,
            properties={
                'default_callback_group': _default_group,
                DEFAULT_GROUP: _default_group,
                'context': context_of_node,
            },
            has=_may_have,
        ),
        'rclpy.publisher.Publisher': LibraryClass(),
    },
    functions={'rclpy.create_node': _create_node},
    aliases={
        'rclpy.lifecycle.LifecycleNode': LIFECYCLE_NODE,
        'rclpy.lifecycle.Node': LIFECYCLE_NODE,
        'rclpy.lifecycle.node.Node': LIFECYCLE_NODE,
        'rclpy.node.create_node': 'rclpy.create_node',
    },
)
