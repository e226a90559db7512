"""Tasks that an executor runs without an entity: ``create_task``, done-callbacks."""

from __future__ import annotations

from ros2cc_extract.extract.static.concurrency.accesses.lost_notifications import (
    note_begun,
    note_made,
)
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.inherited_locks import hand_over
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    EntityState,
    GroupState,
    RosWorld,
    nodes_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import add_entity
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.exclusive_paths import exclusive
from ros2cc_extract.extract.static.python.values.values import (
    Bound,
    Call,
    Const,
    Coroutine,
    Function,
    Instance,
    Mystery,
    Partial,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import EntityKind, GroupType, When

_MOST_ALIKE = 4
"""So many done-callbacks of one text are followed, each with the variables of its own."""


def create_task(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """A task has no entity and no group (rclpy-semantics: work outside every group)."""
    assert isinstance(receiver, Instance)
    nodes = nodes_of(receiver)
    task = call.argument(0)
    if task is not None and (call.args[1:] or call.keywords):
        task = Partial(task, tuple(call.args[1:]), dict(call.keywords))
    add_task(machine, nodes[0] if nodes else None, task, call.place)
    future = machine.future(call.place, 'task')
    note_its_end(machine, future, call.place)
    return future


def note_its_end(machine: RosMachine, future: Value, place: Place) -> None:
    """The future of a task is done when the task has ended, no matter who asks for it."""
    world = machine.world
    world.kept.append(future)
    for entity in world.entities:
        if entity.kind is EntityKind.TASK and entity.place == place:
            waking = Waking(Word.END, entity, place)
            world.wakings.setdefault(id(future), []).append(waking)


def add_task(
    machine: RosMachine,
    node: Instance | None,
    callback: Value | None,
    place: Place,
    kind: EntityKind = EntityKind.TASK,
    key: Value | None = None,
) -> EntityState | None:
    """
    Record group-less work; it runs on the executor of ``node``.

    :param key: the name of the client whose answer it is for.
    :return: ``None`` when it is known already: one function, at one place, for one client.
    """
    world = machine.world
    if node is None:
        node = world.current.node if world.current else next(iter(world.nodes), None)
    if node is None:
        return None
    note_begun(world, place)
    run = callback
    if isinstance(callback, Coroutine):
        made = callback.call
        run = Partial(callback.function, tuple(made.args), dict(made.keywords))
    for known in world.by_node.get(id(node), ()):
        is_here = known.place == place and known.kind is kind
        is_same = is_here and _name_of(known.key) == _name_of(key)
        if is_same and _code_of(known.callback) == _code_of(run):
            _run_too(known, run)
            _count_too(world, known, place)
            hand_over(world, known)
            note_made(world, kind.value, place)
            return None
    entity = add_entity(machine, node, kind, groupless(machine), place)
    entity.callback, entity.key = run, key
    if world.when is not When.START:
        entity.count = 1
    hand_over(world, entity)
    return entity


def _count_too(world: RosWorld, known: EntityState, place: Place) -> None:
    """What the set-up makes once more before anything spins is one more task."""
    is_set_up = world.when is When.START and known.when is When.START and not world.second_pass
    if not is_set_up or isinstance(known.count, Unknown) or exclusive(known.path, world.path):
        return
    if known.path != world.path:
        known.count = Unknown('made at one place, in several branches', place)
    elif isinstance(world.count, Unknown):
        known.count = world.count
    else:
        known.count += world.count


def _run_too(known: EntityState, callback: Value | None) -> None:
    """One function made anew has variables of its own, such as the event that it sets."""
    alike = (known.callback, *known.extra_callbacks)
    if isinstance(callback, Function) and callback not in alike and len(alike) < _MOST_ALIKE:
        known.extra_callbacks += (callback,)


def _name_of(key: Value | None) -> object:
    """Equal for names that are one, as far as they are known."""
    if isinstance(key, Mystery):
        return key.unknown, key.text
    return key.value if isinstance(key, Const) else type(key)


def _code_of(value: Value | None) -> object:
    """Return a key that is equal for functions of one text on one object, with any arguments."""
    if isinstance(value, Partial):
        return _code_of(value.function)
    if isinstance(value, Bound):
        return _object_of(value.receiver), id(value.function.node)
    return id(value.node) if isinstance(value, Function) else type(value)


def _object_of(receiver: Value) -> object:
    """Equal for one object; what callbacks make at one place, again and again, is one too."""
    if isinstance(receiver, Instance) and receiver.born is not None:
        return id(receiver.cls), receiver.place
    return id(receiver)


def groupless(machine: RosMachine) -> Instance:
    """The group that stands for work in no group at all."""
    world = machine.world
    if world.groupless is None:
        group = Instance(Name('rclpy.callback_groups.ReentrantCallbackGroup'), Place(''))
        group.state = GroupState(type=GroupType.REENTRANT, groupless=True)
        group.hint = 'no_group'
        world.groupless = group
    return world.groupless


def node_task(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``node.executor.create_task``, of an executor that is not known."""
    assert isinstance(receiver, Instance)
    node = receiver.slots.get('node')
    owner = node if isinstance(node, Instance) else None
    add_task(machine, owner, call.argument(0), call.place)
    return machine.future(call.place, 'task')
