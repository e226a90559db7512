"""
What a callback waits for, and which other callbacks must run before it goes on.

Source of the table: measured on rclpy 7.1.6 and 9.1.2 (``client.py``, ``action/client.py``,
``timer.py``, ``task.py``): a synchronous call waits for a ``threading.Event`` that is set when
the executor has run the client; ``Rate.sleep`` waits for one set by a timer of the node.
``wait_for_service`` looks at the graph and needs no callback to run.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from ros2cc_extract.findings.model import Remark
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.places import Place
from ros2cc_extract.spec.model import Blocking, Callback, EntityKind


class WaitKind(Enum):
    """What ends a wait."""

    ANSWER = 'answer'
    SIGNAL = 'signal'
    RATE = 'rate'
    AWAIT = 'await'
    SPIN = 'spin'
    SPUN_FUTURE = 'spun future'
    SLEEP = 'sleep'
    PRESENCE = 'presence'
    OTHER = 'other'


BUSY_WAIT = 'busy wait'
EVENT_WAIT = 'Event.wait'
SPIN_FOR_FUTURE = 'spin for future'
ASYNCIO_SLEEP = 'asyncio.sleep'
_KINDS = {
    'client.call': WaitKind.ANSWER,
    'send_goal': WaitKind.ANSWER,
    'get_result': WaitKind.ANSWER,
    'cancel_goal': WaitKind.ANSWER,
    EVENT_WAIT: WaitKind.SIGNAL,
    'Condition.wait': WaitKind.SIGNAL,
    'Condition.wait_for': WaitKind.SIGNAL,
    'Future.result': WaitKind.SIGNAL,
    BUSY_WAIT: WaitKind.SIGNAL,
    'Rate.sleep': WaitKind.RATE,
    SPIN_FOR_FUTURE: WaitKind.SPUN_FUTURE,
    'await': WaitKind.AWAIT,
    'time.sleep': WaitKind.SLEEP,
    'wait_for_service': WaitKind.PRESENCE,
    'wait_for_server': WaitKind.PRESENCE,
}
_SERVERS = {
    EntityKind.CLIENT: (EntityKind.SERVICE,),
    EntityKind.ACTION_CLIENT: (EntityKind.ACTION_SERVER,),
}


@dataclass(frozen=True)
class Wait:
    """
    One wait inside a callback.

    :param needs: callbacks of the same unit that must run before it ends; empty when it ends
        otherwise, or when what it waits for is not known.
    """

    caller: Callback
    block: Blocking
    kind: WaitKind
    needs: tuple[Callback, ...] = ()

    @property
    def place(self) -> Place:
        """Where it waits; the callback itself where the line is not known."""
        caller = self.caller
        return self.block.source or caller.defined or caller.source or Place(caller.name)

    @property
    def has_timeout(self) -> bool:
        """True when it ends after some time in any case."""
        return self.block.seconds is not None

    @property
    def chain(self) -> tuple[Remark, ...]:
        """The calls that lead from the callback to the wait."""
        words = [f'{self.caller.display_name} calls from here']
        words += ['and on from here'] * (len(self.block.chain) - 1)
        return tuple(map(Remark, self.block.chain, words))


def kind_of(block: Blocking) -> WaitKind:
    """Classify a blocking call by its name."""
    is_spin = block.call.rpartition('.')[2].startswith('spin')
    return _KINDS.get(block.call, WaitKind.SPIN if is_spin else WaitKind.OTHER)


def waits_of(context: Context) -> Iterator[Wait]:
    """
    All waits of the callbacks somebody wrote, in the order of the unit.

    A loop that spins while it waits does not keep the executor from serving others.
    """
    for caller in context.written:
        spins = any(kind_of(block) is WaitKind.SPIN for block in caller.blocking)
        for block in caller.blocking:
            if spins and block.call == BUSY_WAIT:
                continue
            yield Wait(caller, block, kind_of(block), tuple(_needs(block, caller, context)))


def _needs(block: Blocking, caller: Callback, context: Context) -> Iterator[Callback]:
    needed = context.by_name.get(block.on) if isinstance(block.on, str) else None
    if kind_of(block) is WaitKind.PRESENCE:
        return
    if needed is None or needed == caller or _exclude_each_other(needed, caller):
        return
    yield needed
    client = _client_before(needed, context)
    if client is not None and client != caller:
        yield client
    server = server_of(client or needed, context)
    if server is not None:
        yield server


def _client_before(done: Callback, context: Context) -> Callback | None:
    """The client whose answer a done-callback is for, where its node has one of that name."""
    if not is_done_callback(done) or not isinstance(done.key, str):
        return None
    found = [
        c for c in context.written if is_client(c) and c.key == done.key and c.node == done.node
    ]
    return found[0] if len(found) == 1 else None


def server_of(client: Callback, context: Context) -> Callback | None:
    """The one server of the unit by the client's name; a remapping is not visible here."""
    kinds = _SERVERS.get(client.entity) if client.entity else None
    if not kinds or not isinstance(client.key, str):
        return None
    found = [c for c in context.written if c.entity in kinds and c.key == client.key]
    return found[0] if len(found) == 1 else None


def is_client(callback: Callback) -> bool:
    """True for what takes the answers of a service or an action."""
    return callback.entity in _SERVERS


def _exclude_each_other(one: Callback, other: Callback) -> bool:
    """True when only one of them is ever created."""
    return one.alternative is not None and one.alternative == other.alternative


def waits_for(wait: Wait) -> str:
    """Say what a wait waits for."""
    needed = wait.needs[0] if wait.needs else None
    if needed is None:
        return 'something else'
    if is_client(needed) or is_done_callback(needed):
        return f'the answer of {name_of_service(needed)}'
    return needed.display_name


def name_of_service(client: Callback) -> str:
    """Name the service or action of a client."""
    name = f' {client.key!r}' if isinstance(client.key, str) else ''
    return f'{"action" if client.entity is EntityKind.ACTION_CLIENT else "service"}{name}'


def waits_in(wait: Wait) -> str:
    """Say where it waits: the call, the loop, the nested spin."""
    words = {BUSY_WAIT: 'a busy loop', SPIN_FOR_FUTURE: 'a nested spin'}
    return words.get(wait.block.call, wait.block.call)


def how_it_ends(wait: Wait) -> str:
    """Say what becomes of a wait that nobody can end."""
    if wait.has_timeout:
        return 'it always runs into its time-out'
    is_event = wait.block.call == EVENT_WAIT and not is_done_callback(wait.needs[0])
    return 'it waits for ever' + (', unless the event was set before' if is_event else '')


def is_done_callback(callback: Callback) -> bool:
    """True for what runs when an answer has come."""
    return callback.entity is EntityKind.DONE_CALLBACK
