"""
Executors and the calls that spin them.

Sources: rclpy 7.1.6, ``__init__.py`` (the ``spin…`` functions take the node out of any other
executor and, when they return, out of theirs), ``executors.py`` (``add_node``; the default
number of threads is the number of CPUs the process may use).
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Sequence

from ros2cc_extract.extract.static.concurrency import activities
from ros2cc_extract.extract.static.concurrency.accesses import kept_threads
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import note_over
from ros2cc_extract.extract.static.libraries.rclpy.machine.assumptions import assumption
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    REMOVE_NODE,
    SHUTDOWN_EXECUTOR,
    note_end,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    ExecutorState,
    InsideSpin,
    NodeState,
    Spin,
    nodes_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import ghost_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.tasks import create_task, node_task
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Call,
    Choice,
    Class,
    Const,
    Handler,
    Instance,
    Mystery,
    Native,
    Value,
    choice,
    options_of,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import When

BASE = 'rclpy.executors.Executor'
SINGLE = 'rclpy.executors.SingleThreadedExecutor'
MULTI = 'rclpy.executors.MultiThreadedExecutor'
EVENTS = 'rclpy.experimental.EventsExecutor'

Awaited = tuple[Value | None, Value | None]
_MANY_THREADS = 128
"""A pool starts threads as it needs them: what lies above this is meant as "enough"."""


_SPIN_OVERRIDES = frozenset(
    [
        'spin',
        'spin_once',
        'spin_until_future_complete',
        '_spin_once_impl',
        'wait_for_ready_callbacks',
        '_wait_for_ready_callbacks',
        '_make_handler',
        'create_task',
    ]
)


def _make(machine: RosMachine, instance: Instance) -> ExecutorState:
    names = {cls.name for cls in instance.mro if isinstance(cls, Name)}
    state = ExecutorState(kind=instance.class_name)
    if MULTI in names:
        state.threads = None
    if isinstance(instance.cls, Class):
        _describe_custom(instance.cls, names, state)
    instance.slots['__nodes__'] = ()
    machine.world.executors.append(instance)
    return state


def _describe_custom(cls: Class, names: set[str], state: ExecutorState) -> None:
    base = next((name for name in (MULTI, SINGLE, EVENTS) if name in names), None)
    changed = [
        name
        for entry in cls.mro
        if isinstance(entry, Class)
        for name in entry.slots
        if name in _SPIN_OVERRIDES
    ]
    if base is None:
        state.unresolved = Unknown(f'custom executor class {cls.name}', cls.place)
    elif changed:
        reason = f'custom executor class {cls.name} overrides {changed[0]}'
        state.unresolved = Unknown(reason, cls.place)
    else:
        state.assumed = f'{cls.name} schedules as its base {base.rpartition(".")[2]}'


def _init(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)
    state = receiver.state
    names = {cls.name for cls in receiver.mro if isinstance(cls, Name)}
    if isinstance(state, ExecutorState) and MULTI in names:
        _set_threads(state, call.argument(0, 'num_threads'), call.place)
    return NONE


def _is_count(value: Const) -> bool:
    return isinstance(value.value, int) and value.value > 0


def _set_threads(state: ExecutorState, value: Value | None, place: Place) -> None:
    if value is None or value == NONE:
        return
    state.threads_at = place
    if isinstance(value, Const) and _is_count(value):
        state.threads = min(value.value, _MANY_THREADS)
        if value.value > _MANY_THREADS:
            state.assumed = f'{_MANY_THREADS} threads behave as {value.value} do'
        return
    default = value.default if isinstance(value, Mystery) else None
    if isinstance(value, Mystery) and isinstance(default, Const) and _is_count(default):
        state.threads = min(default.value, _MANY_THREADS)
        state.assumed = assumption('number of threads', value)
        return
    state.threads = 2
    reason = value.unknown.reason if isinstance(value, Mystery) else 'computed at run time'
    text = f'{value.text}: ' if isinstance(value, Mystery) and value.text else ''
    state.threads_unresolved = Unknown(f'thread count {text}{reason}', place)


def as_executor(machine: RosMachine, value: Value, place: Place) -> Instance:
    """The executor that ``value`` is; an unresolved one where that cannot be followed."""
    if isinstance(value, Instance) and isinstance(value.state, ExecutorState):
        return value
    reason = value.unknown.reason if isinstance(value, Mystery) else 'not a known executor'
    text = f'{value.text}: ' if isinstance(value, Mystery) and value.text else ''
    key = f'executor|{text}|{reason}'
    known = machine.world.ghosts.get(key)
    if known is None:
        known = Instance(Name(BASE), place)
        known.state = ExecutorState(kind='unknown', unknown=Unknown(f'{text}{reason}', place))
        known.slots['__nodes__'] = ()
        machine.world.ghosts[key] = known
        machine.world.executors.append(known)
    return known


def as_node(machine: RosMachine, value: Value | None) -> Instance | None:
    """The node that ``value`` is or may be; a ghost for a mystery; ``None`` for anything else."""
    if isinstance(value, Choice):
        nodes = [as_node(machine, option) for option in options_of(value) if option != NONE]
        return nodes[0] if nodes and all(node is nodes[0] for node in nodes) else None
    if isinstance(value, Instance) and isinstance(value.state, NodeState):
        return value
    if isinstance(value, Instance):
        return machine.become_node(value) or _node_behind(machine, value)
    return ghost_node(machine, value) if isinstance(value, Mystery) else None


def _node_behind(machine: RosMachine, value: Instance) -> Instance | None:
    """The node to which an object of another class hands its attributes on."""
    method = machine.attribute(value, 'create_publisher', value.place)
    behind = method.receiver if isinstance(method, Native) else None
    if isinstance(behind, Instance) and isinstance(behind.state, NodeState):
        return behind
    return None


def add_node(machine: RosMachine, executor: Instance, node: Instance) -> None:
    """Add ``node``, which leaves any other executor it is in."""
    old = node.slots.get('__executor__')
    for other in options_of(old) if isinstance(old, Value) else ():
        if isinstance(other, Instance) and other is not executor:
            remove_node(machine, other, node)
    entries = executor.slots['__nodes__']
    if node not in entries:
        machine.store.write(executor, '__nodes__', (*entries, node))
    machine.store.write(node, '__executor__', executor)
    machine.store.write(node, '__owner__', executor)


def remove_node(machine: RosMachine, executor: Instance, node: Instance) -> None:
    """Take ``node`` out of ``executor``."""
    entries = tuple(
        choice([o for o in (e.options if hasattr(e, 'options') else (e,)) if o is not node])
        for e in executor.slots['__nodes__']
        if e is not node and tuple(options_of(e)) != (node,)
    )
    machine.store.write(executor, '__nodes__', tuple(e for e in entries if e is not ABSENT))
    if node.slots.get('__executor__') is executor:
        machine.store.remove(node, '__executor__')


def global_executor(machine: RosMachine) -> Instance:
    """The executor of ``rclpy.spin``: single-threaded, made on first use."""
    world = machine.world
    if world.global_executor is None:
        executor = Instance(Name(SINGLE), Place(''))
        executor.state = ExecutorState('SingleThreadedExecutor', is_global=True)
        executor.slots['__nodes__'] = ()
        world.global_executor = executor
    return world.global_executor


def record_spin(
    machine: RosMachine,
    executor: Instance,
    how: str,
    place: Place,
    ever: bool,
    timeout: Value | None = None,
    *,
    takes: bool = False,
) -> None:
    world = machine.world
    if world.second_pass:
        return
    activities.spins(world, for_ever=ever)
    nodes = nodes_of(executor)
    executor.state.spun = True
    spin = Spin(executor, nodes, how, place, world.path, ever, world.in_thread)
    spin.repeated, spin.takes = isinstance(world.count, Unknown), takes
    spin.timeout, spin.thread = None if timeout == NONE else timeout, world.thread
    spin.is_tried, spin.by = bool(world.caught), world.activity
    spin.may_have_loop = _may_have_loop(machine)
    kept_threads.note_goes_on(world)
    spin.from_callback = world.current is not None
    spin.over = 0 if spin.from_callback else world.spins_over  # followed behind all of main
    known = next((old for old in world.spins.values() if _is_the_same(spin, old)), None)
    known = known or world.spins.setdefault(spin.key, spin)
    if world.when is When.START:
        _note_beside(known, spin, world.spins.values())
    known.chains[world.chain[1:]] = None
    for node in nodes:
        node.state.spun, node.state.loop = True, world.loop
    if world.in_thread:
        return
    if world.when is When.START:
        machine.store.keep_contents()
    # Callbacks of a pool go on beside what comes behind a spin that ends.
    world.main_spins += world.when is When.START and (ever or executor.state.threads == 1)
    if ever:
        world.after_spin = True


def _may_have_loop(machine: RosMachine) -> bool:
    """Whether what is followed may run inside a loop of asyncio, as a coroutine does."""
    world = machine.world
    calls = machine.stack[world.thread_depth :]
    is_coroutine = any(isinstance(call.node, ast.AsyncFunctionDef) for call in calls)
    is_of_others = world.by_loop or world.when is When.LATER
    return world.loop is not None or is_of_others or is_coroutine


def _note_beside(known: Spin, again: Spin, spins: Collection[Spin]) -> None:
    """One call is met again, perhaps by another thread, and perhaps while it is not over."""
    by = again.by
    if known is not again and known.in_thread and by is not None and by not in known.beside:
        is_other = by is not known.by or len(by.runners) > 1
        if is_other and again.over <= list(spins).index(known):
            known.beside.append(by)


def _is_the_same(spin: Spin, other: Spin) -> bool:
    """Whether one text is met again that makes an executor for a node that is there already."""
    made_anew = spin.executor is not other.executor and spin.executor.cls is other.executor.cls
    same_text = (spin.place, spin.executor.place) == (other.place, other.executor.place)
    return made_anew and same_text and bool(spin.nodes) and spin.nodes == other.nodes


def future_of(call: Call, position: int, how: str) -> Awaited:
    """The future a nested spin waits for, if it waits for one, and its time-out."""
    if how == 'spin_once':
        return None, call.argument(None if position else 0, 'timeout_sec')
    if how != 'spin_until_future_complete':
        return None, None
    timeout = call.argument(position + 2 if position else 1, 'timeout_sec')
    return call.argument(position, 'future'), timeout


def note_served_inside(nodes: Sequence[Instance], how: str, place: Place) -> None:
    for node in nodes:
        node.state.nested = node.state.nested or (how, place)


def note_inside(
    machine: RosMachine,
    executor: Instance,
    how: str,
    timeout: Value | None,
    place: Place,
    nodes: tuple[Instance, ...],
    *,
    is_for_library: bool = False,
) -> None:
    """A callback spins ``executor``, which has ``nodes`` then."""
    world = machine.world
    if world.current is not None:
        given = None if timeout == NONE else timeout
        spin = InsideSpin(
            world.current, executor, how, given, place, world.held, nodes, is_for_library
        )
        world.inside_spins.append(spin)


def _method_spin(how: str, ever: bool) -> Handler:
    def spin(machine: RosMachine, receiver: Value, call: Call) -> Value:
        assert isinstance(receiver, Instance)
        future = future_of(call, 0, how)
        if machine.note_nested_spin(f'executor.{how}', None, receiver, future, call.place):
            note_served_inside(nodes_of(receiver), how, call.place)
            note_inside(
                machine, receiver, f'executor.{how}', future[1], call.place, nodes_of(receiver)
            )
        else:
            record_spin(machine, receiver, how, call.place, ever, future[1])
            machine.note_outside_wait(how, *future, call.place, nodes_of(receiver))
        return machine.mystery(f'result of {how}', call.place)

    return spin


def _add(machine: RosMachine, receiver: Value, call: Call) -> Value:
    assert isinstance(receiver, Instance)

    def act(value: Value) -> Value:
        node = as_node(machine, value)
        if node is not None:
            machine.note_change('add_node', node, call.place)
            add_node(machine, receiver, node)
        return NONE

    return machine.each(call.argument(0, 'node') or NONE, act, call.place)


def _remove(machine: RosMachine, receiver: Value, call: Call) -> Value:
    node = call.argument(0, 'node')
    if (
        isinstance(receiver, Instance)
        and isinstance(node, Instance)
        and isinstance(node.state, NodeState)
        and not machine.world.after_spin
    ):
        _note_served_so_far(machine, receiver, node)
        remove_node(machine, receiver, node)
        machine.note_change('remove_node', node, call.place)
        note_end(machine, REMOVE_NODE, node, call.place)
    return NONE


def _note_served_so_far(machine: RosMachine, executor: Instance, node: Instance) -> None:
    """A thread that spins on has served the node until it is taken out."""
    for spin in machine.world.spins.values():
        is_served = spin.executor is executor and spin.in_thread and spin.for_ever
        if is_served and node in nodes_of(executor) and node not in spin.nodes:
            spin.nodes = (*spin.nodes, node)


def _get_nodes(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return machine.mystery('nodes of the executor at run time', call.place)


def node_executor(machine: RosMachine, receiver: Instance, place: Place) -> Value:
    """``node.executor``: the one that it was added to, as far as that is seen."""
    found = receiver.slots.get('__executor__')
    if found is None and machine.world.in_callback:
        found = receiver.slots.get('__owner__')  # a callback runs while it is spun
    known = options_of(found) if isinstance(found, Value) else ()
    if known:
        return choice(list(known))
    made = Instance(Name('rclpy.executors.NodeExecutor'), place)
    made.state = receiver.state
    made.slots['node'] = receiver
    return made


def _shut_down(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Spins that go on in other threads end."""
    world = machine.world
    if isinstance(receiver, Instance):
        is_limited = not _is_for_ever(call.argument(0, 'timeout_sec'))
        note_end(machine, SHUTDOWN_EXECUTOR, receiver, call.place, is_limited=is_limited)
    if not world.in_callback and not world.in_thread:
        world.spins_over = len(world.spins)
        note_over(world, receiver)
    return NONE


def _is_for_ever(timeout: Value | None) -> bool:
    """``None`` and negative seconds are no limit. Source: rclpy 7.1.6, ``Executor.shutdown``."""
    if timeout is None or timeout == NONE:
        return True
    seconds = timeout.value if isinstance(timeout, Const) else None
    return isinstance(seconds, int | float) and seconds < 0


EXECUTOR_METHODS: dict[str, Handler] = {
    'add_node': _add,
    'remove_node': _remove,
    'spin': _method_spin('spin', True),
    'spin_once': _method_spin('spin_once', False),
    'spin_until_future_complete': _method_spin('spin_until_future_complete', False),
    'spin_once_until_future_complete': _method_spin('spin_once_until_future_complete', False),
    'create_task': create_task,
    'get_nodes': _get_nodes,
    'shutdown': _shut_down,
    'wake': lambda machine, receiver, call: NONE,
}

_CLASS = LibraryClass(state=_make, init=_init, methods=EXECUTOR_METHODS)

TABLE = Library(
    classes={
        BASE: _CLASS,
        SINGLE: LibraryClass(bases=(BASE,)),
        MULTI: LibraryClass(bases=(BASE,)),
        EVENTS: LibraryClass(bases=(BASE,)),
        'rclpy.executors.NodeExecutor': LibraryClass(methods={'create_task': node_task}),
    },
    functions={
        'rclpy.get_global_executor': lambda machine, receiver, call: global_executor(machine),
    },
    aliases={
        'rclpy.SingleThreadedExecutor': SINGLE,
        'rclpy.experimental.events_executor.EventsExecutor': EVENTS,
        'rclpy.experimental.events_executor.events_executor.EventsExecutor': EVENTS,
        'rclpy.executors.EventsExecutor': EVENTS,
    },
)
