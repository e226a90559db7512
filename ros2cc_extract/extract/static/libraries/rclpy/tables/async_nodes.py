"""
Nodes that a loop of asyncio runs: ``rclpy.experimental.AsyncNode``.

Each timer, subscription, service and client is a task that reads what has arrived and awaits its
callback, so that its runs are one by one; with ``concurrent=True`` each run is a task of its own.
There are no callback groups and there is one thread. The executor of such a unit stands for the
loop. Source: rclpy 10.0.10 and 11.0.0, ``experimental/async_node.py``, ``async_subscription.py``,
``async_service.py``, ``async_timer.py``, ``async_client.py``, ``async_clock.py``.
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    LOOP_KIND,
    EntityState,
    ExecutorState,
    GroupState,
    NodeState,
    RosWorld,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.clocks import clock_of
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import (
    BASE,
    add_node,
    record_spin,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import new_group
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    NODE,
    NODE_METHODS,
    add_entity,
    init_node,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.tasks import groupless
from ros2cc_extract.extract.static.libraries.standard.asyncio_loops import (
    IN_TASK,
    coroutine_of,
)
from ros2cc_extract.extract.static.libraries.standard.futures import LOOP
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import (
    NONE,
    Call,
    Const,
    Handler,
    Instance,
    Mystery,
    Native,
    Value,
)
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import AWAIT
from ros2cc_extract.spec.model import OF_LOOP, EntityKind, GroupType, When

ASYNC_NODE = 'rclpy.experimental.async_node.AsyncNode'
_CLIENT = 'rclpy.experimental.async_client.AsyncClient'
_CLOCK = 'rclpy.experimental.async_clock.AsyncClock'
_POSITIONAL = {
    'create_subscription': 4,
    'create_timer': 2,
    'create_service': 3,
    'create_client': 2,
}


def _init(machine: RosMachine, receiver: Value, call: Call) -> Value:
    init_node(machine, receiver, call)
    if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
        receiver.state.on_asyncio = True
        add_node(machine, _new_loop(machine, call.place), receiver)
    return NONE


def _new_loop(machine: RosMachine, place: Place) -> Instance:
    """Which loop runs a node is known when it is entered."""
    executor = Instance(Name(BASE), place)
    executor.state = ExecutorState(LOOP_KIND)
    executor.slots['__nodes__'] = ()
    executor.hint = 'asyncio_loop'
    machine.world.executors.append(executor)
    return executor


def _enter(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``async with node``: the loop runs it beside the block."""
    if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
        _run_beside(machine, receiver, 'async with', call.place)
        _go_on_beside(machine, receiver, call.place)
    return receiver


def _leave(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """The node is destroyed behind the block; with the first one all beside it is over."""
    world = machine.world
    current = world.current
    if isinstance(current, EntityState) and current.is_set_up and current.node is receiver:
        world.current, world.effects, world.after_spin = None, None, True
    return NONE


def _run(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """``node.run()`` goes on until the node is destroyed."""

    def run(machine: RosMachine, _: Value, inner: Call) -> Value:
        if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
            _run_beside(machine, receiver, 'AsyncNode.run', inner.place)
            if not machine.world.in_callback:
                machine.world.after_spin = True
        return NONE

    def run_as_task(machine: RosMachine, _: Value, inner: Call) -> Value:
        if isinstance(receiver, Instance) and isinstance(receiver.state, NodeState):
            _run_beside(machine, receiver, 'AsyncNode.run', inner.place)
            _go_on_beside(machine, receiver, inner.place)
        return NONE

    coroutine = coroutine_of('AsyncNode.run', run, call)
    coroutine.slots[IN_TASK] = Native('AsyncNode.run', run_as_task)
    return coroutine


def _run_beside(machine: RosMachine, node: Instance, how: str, place: Place) -> None:
    world = machine.world
    key, own = world.loop or id(node), node.slots.get('__executor__')
    executor = world.loops.get(key) or (own if isinstance(own, Instance) else None)
    executor = world.loops[key] = executor or _new_loop(machine, place)
    add_node(machine, executor, node)
    spins = (spin for spin in world.spins.values() if spin.executor is executor)
    spin = next(spins, None)
    if spin is not None:
        spin.nodes = tuple(dict.fromkeys((*spin.nodes, node)))
        node.state.spun, node.state.loop = True, world.loop
        return
    before, world.in_thread = world.in_thread, True
    record_spin(machine, executor, how, place, True)
    world.in_thread = before


def _go_on_beside(machine: RosMachine, node: Instance, place: Place) -> None:
    """
    From here on the set-up is one more task of the loop.

    It is followed where it stands, as what it makes is made once.
    """
    world = machine.world
    is_set_up = world.when is When.START and world.effects is None and not world.in_thread
    if not is_set_up or world.after_spin or not world.is_program:
        return
    entity = add_entity(machine, node, EntityKind.TASK, groupless(machine), place)
    entity.callback = machine.stack[-1] if machine.stack else None
    entity.one_shot, entity.is_set_up, entity.effects = True, True, EffectLog()
    world.current, world.effects, world.callback_path = entity, entity.effects, world.path


def loop_node(world: RosWorld) -> Instance | None:
    """A node that the loop runs which runs the code that is followed, if there is one."""
    current = world.current
    if world.is_on_loop and isinstance(current, EntityState):
        return current.node
    if world.loop is None or world.in_thread or world.effects is not None:
        return None
    nodes = (node for node in world.nodes if isinstance(node.state, NodeState))
    return next((node for node in nodes if node.state.on_asyncio), None)


def node_of_loop(world: RosWorld, loop: Value) -> Instance | None:
    """A node that ``loop`` runs, if it is known which loop that is."""
    begin = loop.slots.get(LOOP) if isinstance(loop, Instance) else None
    nodes = (node for node in world.nodes if isinstance(node.state, NodeState))
    found = (node for node in nodes if node.state.on_asyncio and node.state.loop == begin)
    return next(found, None) if begin is not None else None


def _creator(name: str) -> Handler:
    """As that of a node, in a group of its own: what would be its position is something else."""
    original, positions = NODE_METHODS[name], _POSITIONAL[name]

    def create(machine: RosMachine, receiver: Value, call: Call) -> Value:
        keywords = dict(call.keywords)
        keywords['callback_group'] = _own_group(machine, keywords.pop('concurrent', None), call)
        inner = Call(call.place, call.args[:positions], keywords, call.more, call.text)
        made = original(machine, receiver, inner)
        if name == 'create_client' and isinstance(made, Instance):
            made.cls = Name(_CLIENT)
        return made

    return create


def _own_group(machine: RosMachine, concurrent: Value | None, call: Call) -> Instance:
    state = GroupState(library=OF_LOOP)
    if concurrent == Const(True):
        state.type = GroupType.REENTRANT
    elif concurrent is not None and not isinstance(concurrent, Const):
        why = concurrent.unknown.reason if isinstance(concurrent, Mystery) else 'of a branch'
        state.unresolved = Unknown(f'concurrent: {why}', call.place)
    return new_group(machine, state, call.place, None)


def _destroy_node(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """That is how ``run`` ends: what the node awaits is cancelled."""
    return NONE


def _call(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """It sends and waits when it is awaited."""

    def send(machine: RosMachine, _: Value, inner: Call) -> Value:
        machine.note_await(machine.future(call.place, 'asyncio', receiver), inner.place)
        return machine.mystery('an answer at run time', inner.place, 'await call(…)')

    return coroutine_of('AsyncClient.call', send, call)


def _waits_outside(name: str) -> Handler:
    def wait(machine: RosMachine, receiver: Value, call: Call) -> Value:
        def ask(machine: RosMachine, _: Value, inner: Call) -> Value:
            machine.note_blocking(f'{AWAIT} {name}', None, None, inner.place)
            return NONE

        return coroutine_of(name, ask, call)

    return wait


def _clock(machine: RosMachine, receiver: Value, call: Call) -> Value:
    """Its ``sleep`` is a coroutine; where the time is simulated, it is that of every node."""
    state = receiver.state if isinstance(receiver, Instance) else None
    if isinstance(state, NodeState) and state.sim_clock is not None:
        return clock_of(machine, receiver, call)
    clock = Instance(Name(_CLOCK), call.place)
    clock.state = PlainState('clock', of=receiver, place=call.place)
    return clock


def _sleep(machine: RosMachine, receiver: Value, call: Call) -> Value:
    seconds = call.argument(0, 'duration_sec')

    def sleep(machine: RosMachine, _: Value, inner: Call) -> Value:
        machine.note_blocking(f'{AWAIT} Clock.sleep', None, seconds, inner.place)
        return NONE

    return coroutine_of('AsyncClock.sleep', sleep, call)


TABLE = Library(
    classes={
        ASYNC_NODE: LibraryClass(
            init=_init,
            bases=(NODE,),
            methods={
                **{name: _creator(name) for name in _POSITIONAL},
                '__aenter__': _enter,
                '__aexit__': _leave,
                'run': _run,
                'destroy_node': _destroy_node,
                'wait_for_node': _waits_outside('AsyncNode.wait_for_node'),
                'get_clock': _clock,
            },
        ),
        _CLIENT: LibraryClass(
            methods={
                'call': _call,
                'wait_for_service': _waits_outside('AsyncClient.wait_for_service'),
            }
        ),
        _CLOCK: LibraryClass(bases=('rclpy.clock.ROSClock',), methods={'sleep': _sleep}),
    },
    aliases={
        'rclpy.experimental.AsyncNode': ASYNC_NODE,
        'rclpy.experimental.asyncio.AsyncNode': ASYNC_NODE,
    },
)
