"""For what a program waits before it is spun, and what it makes only behind such a wait."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.extract.static.concurrency.machine.state import SetUpWait
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Instance
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import EntityKind, When
from ros2cc_extract.spec.node_graph import Awaited

_CLIENTS = (EntityKind.CLIENT, EntityKind.ACTION_CLIENT)
_PRESENCE = ('wait_for_service', 'wait_for_server', 'service_is_ready', 'server_is_ready')


def awaits_of(node: Instance, world: RosWorld) -> Iterator[Awaited]:
    """Waits for the services and actions of the clients of a node, in their order."""
    for wait in world.set_up.values():
        client = client_of(wait)
        place = wait.block.source
        is_mine = client is not None and client.node is node and client.when is When.START
        if client is not None and place is not None and is_mine and _is_endless(wait, world):
            answers = wait.block.call not in _PRESENCE
            yield Awaited(client=client.place, place=place, answers=answers)


def waits_before(entity: EntityState, world: RosWorld) -> tuple[Place, ...]:
    """The waits without an end that come before an entity of the set-up is made."""
    if entity.when is not When.START or entity.path:
        return ()
    before = list(world.set_up.values())[: entity.after]
    places = (wait.block.source for wait in before if _is_endless(wait, world))
    return tuple(dict.fromkeys(place for place in places if place is not None))


def _is_endless(wait: SetUpWait, world: RosWorld) -> bool:
    """Whether the main program stands there until it is answered, on every branch."""
    block = wait.block
    is_of_main = wait.by is None and not wait.outside.in_thread and wait.uncalled is None
    is_endless = block.seconds is None or block.source in world.asked_until
    return is_of_main and is_endless and not block.conditional and not wait.is_late


def client_of(wait: SetUpWait) -> EntityState | None:
    """The client that is asked, itself or by the future of its answer."""
    thing = wait.outside.client
    state = thing.state if isinstance(thing, Instance) else None
    of = state.of if isinstance(state, PlainState) and state.of is not None else thing
    found = of.state if isinstance(of, Instance) else None
    return found if isinstance(found, EntityState) and found.kind in _CLIENTS else None
