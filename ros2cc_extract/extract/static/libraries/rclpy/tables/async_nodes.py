"""
Nodes that asyncio runs, with no executor and no callback groups: ``rclpy.experimental.AsyncNode``.

Their callbacks are tasks of an asyncio loop, so that an ``await`` keeps nothing closed. No model
has that loop; the unit says that its executor is not known. Source: rclpy 10.0.10,
``experimental/async_node.py``, ``async_client.py`` (``call`` is a coroutine).
"""

from __future__ import annotations

from ros2cc_extract.extract.static.libraries.rclpy.machine.machine import RosMachine
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    ExecutorState,
    GroupState,
    NodeState,
    Spin,
)
from ros2cc_extract.extract.static.libraries.rclpy.tables.executors import BASE, add_node
from ros2cc_extract.extract.static.libraries.rclpy.tables.groups import new_group
from ros2cc_extract.extract.static.libraries.rclpy.tables.nodes import (
    NODE,
    NODE_METHODS,
    init_node,
)
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryClass
from ros2cc_extract.extract.static.python.values.values import NONE, Call, Handler, Instance, Value
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import GroupType

ASYNC_NODE = 'rclpy.experimental.async_node.AsyncNode'
_CLIENT = 'rclpy.experimental.async_client.AsyncClient'
_WHY = 'asyncio runs it, and no executor: how it serves its callbacks is not modelled'
_GROUP = '__asyncio_group__'
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
        group = GroupState(type=GroupType.REENTRANT, library='asyncio', node=receiver)
        receiver.slots[_GROUP] = new_group(machine, group, call.place, 'asyncio')
        _serve(machine, receiver, call.place)
    return NONE


def _serve(machine: RosMachine, node: Instance, place: Place) -> None:
    world = machine.world
    executor = Instance(Name(BASE), place)
    executor.state = ExecutorState('AsyncNode', unknown=Unknown(_WHY, place), spun=True)
    executor.slots['__nodes__'] = ()
    executor.hint = 'asyncio_loop'
    world.executors.append(executor)
    add_node(machine, executor, node)
    spin = Spin(executor, (node,), 'AsyncNode', place, world.path, True, world.in_thread)
    world.spins.setdefault(spin.key, spin)
    node.state.spun = True


def _creator(name: str) -> Handler:
    """As that of a node, in no group: what would be its position may mean something else."""
    original, positions = NODE_METHODS[name], _POSITIONAL[name]

    def create(machine: RosMachine, receiver: Value, call: Call) -> Value:
        group = receiver.slots.get(_GROUP) if isinstance(receiver, Instance) else None
        keywords = dict(call.keywords)
        if isinstance(group, Instance):
            keywords['callback_group'] = group
        inner = Call(call.place, call.args[:positions], keywords, call.more, call.text)
        made = original(machine, receiver, inner)
        if name == 'create_client' and isinstance(made, Instance):
            made.cls = Name(_CLIENT)
        return made

    return create


def _call(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return machine.future(call.place, 'asyncio', receiver)


def _wait(machine: RosMachine, receiver: Value, call: Call) -> Value:
    return machine.mystery('a coroutine of asyncio', call.place, 'wait_for_service(…)')


TABLE = Library(
    classes={
        ASYNC_NODE: LibraryClass(
            init=_init,
            bases=(NODE,),
            methods={name: _creator(name) for name in _POSITIONAL},
        ),
        _CLIENT: LibraryClass(methods={'call': _call, 'wait_for_service': _wait}),
    },
    aliases={
        'rclpy.experimental.AsyncNode': ASYNC_NODE,
        'rclpy.experimental.asyncio.AsyncNode': ASYNC_NODE,
    },
)
