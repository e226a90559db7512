"""
What callbacks and threads wait for, and which other callbacks must run before it goes on.

Source of the table: measured on rclpy 7.1.6 and 9.1.2 (``client.py``, ``action/client.py``,
``timer.py``, ``task.py``): a synchronous call waits for a ``threading.Event`` that is set when
the executor has run the client; ``Rate.sleep`` waits for one set by a timer of the node.
``wait_for_service`` looks at the graph and needs no callback to run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from enum import Enum
from typing import TypeVar

from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.base.wording import called, listing, shown
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.client_server_pairs import (
    client_before,
    is_client,
    is_done_callback,
    server_of,
)
from ros2cc_extract.spec.effects import (
    ANSWER_LOOP,
    BUSY_LOOP,
    POLLING_LOOP,
    RECURSION_LIMIT,
    TIME,
    WORKING_LOOP,
    Blocking,
)
from ros2cc_extract.spec.model import Callback, EntityKind, exclude_each_other


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
    TRANSFORM = 'transform'
    OTHER = 'other'


W = TypeVar('W', bound='AnyWait')
BUSY_WAIT = 'busy wait'
EVENT_WAIT = 'Event.wait'
SPIN_FOR_FUTURE = 'spin for future'
ASYNCIO_SLEEP = 'asyncio.sleep'
_CALL = 'client.call'
_KINDS = {
    _CALL: WaitKind.ANSWER,
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
    'time.sleep': WaitKind.SLEEP,
    BUSY_LOOP: WaitKind.SLEEP,
    'wait_for_service': WaitKind.PRESENCE,
    'wait_for_server': WaitKind.PRESENCE,
    'BufferClient.lookup_transform': WaitKind.ANSWER,
    'BufferClient.lookup_transform_full': WaitKind.ANSWER,
    'BufferClient.can_transform': WaitKind.ANSWER,
    'BufferClient.can_transform_full': WaitKind.ANSWER,
}


@dataclass(frozen=True)
class AnyWait:
    """
    One wait, of a callback or of a thread of the program's own.

    :param needs: callbacks of the same unit that must run before it ends; empty when it ends
        otherwise, or when what it waits for is not known.
    """

    caller: Doer
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
        words = [f'{called(self.caller)} calls from here']
        words += ['and on from here'] * (len(self.block.chain) - 1)
        return tuple(map(Remark, self.block.chain, words))


@dataclass(frozen=True)
class Wait(AnyWait):
    """One wait inside a callback."""

    caller: Callback


def kind_of(block: Blocking) -> WaitKind:
    """Classify a blocking call by its name."""
    if block.suspends:
        return WaitKind.AWAIT
    known = _KINDS.get(block.call)
    if known is not None:
        return known
    if block.call.startswith('Clock.'):
        by_time = any(waker.by == TIME for waker in block.wakers)
        return WaitKind.SLEEP if by_time else WaitKind.SIGNAL
    if block.call.startswith('Buffer.'):
        return WaitKind.TRANSFORM
    is_spin = block.call.rpartition('.')[2].startswith('spin')
    return WaitKind.SPIN if is_spin else WaitKind.OTHER


def waits_of(context: Context) -> Iterator[Wait]:
    """
    All waits of the user's callbacks, in the order of the unit.

    A loop that steps an executor until a future is done is a nested spin for that future, reported
    where it steps.
    """
    for caller in context.written:
        step = next((block for block in caller.blocking if kind_of(block) is WaitKind.SPIN), None)
        for block in caller.blocking:
            if step is not None and block.call == BUSY_WAIT:
                if not _steps_this_unit(step, context):
                    continue
                block = _stepped(block, step)
            yield Wait(caller, block, kind_of(block), tuple(_needs(block, caller, context)))


def polls_for_a_time(wait: AnyWait) -> bool:
    """Whether it is a loop on plain data that ends in any case; CC109 explains the others."""
    return wait.block.call == POLLING_LOOP and wait.has_timeout


def _steps_this_unit(step: Blocking, context: Context) -> bool:
    unit = context.unit
    return step.call.endswith('.spin_once') and step.on in (*unit.nodes, unit.executor.name)


def _stepped(loop: Blocking, step: Blocking) -> Blocking:
    return replace(loop, call=SPIN_FOR_FUTURE, source=step.source, chain=step.chain)


def _needs(block: Blocking, caller: Callback, context: Context) -> Iterator[Callback]:
    needed = context.by_name.get(block.on) if isinstance(block.on, str) else None
    needed = needed or _one_of_a_client(block, context)
    if kind_of(block) is WaitKind.PRESENCE or block.goes_by_data:
        return
    if needed is None or needed == caller or exclude_each_other(needed, caller):
        return
    yield needed
    client = client_before(needed, context.written)
    if client is not None and client != caller:
        yield client
    server = server_of(client or needed, context.written)
    if server is not None:
        yield server


def _one_of_a_client(block: Blocking, context: Context) -> Callback | None:
    """Of several that may end a wait, one, where all come behind the answers of one client."""
    wakers = [context.by_name.get(waker.by) for waker in block.wakers]
    clients = {client_before(each, context.written) if each else None for each in wakers}
    is_one = len(clients) == 1 and None not in clients and block.escapes is None
    return wakers[0] if is_one else None


def waits_for(wait: Wait) -> str:
    """Say what a wait waits for."""
    needed = wait.needs[0] if wait.needs else None
    if needed is None:
        return 'something else'
    if _is_answered(needed):
        return f'the answer of {name_of_service(needed)}'
    return needed.display_name


def all_wait_for(waits: Sequence[Wait]) -> str:
    """Say what waits at one line wait for."""
    needed = [wait.needs[0] for wait in waits if wait.needs]
    services = dict.fromkeys(name_of_service(one) for one in needed if _is_answered(one))
    if len(services) < 2 or not all(map(_is_answered, needed)):
        return listing((waits_for(wait) for wait in waits), _SHOWN)
    return f'the answers of {listing(services, _SHOWN)}'


def _is_answered(needed: Callback) -> bool:
    return is_client(needed) or is_done_callback(needed)


_SHOWN = 3


def name_of_service(client: Callback) -> str:
    """Name the service or action of a client."""
    name = f' {client.key!r}' if isinstance(client.key, str) else ''
    return f'{"action" if client.entity is EntityKind.ACTION_CLIENT else "service"}{name}'


def waits_in(wait: AnyWait) -> str:
    """Say where it waits: the call, the loop, the nested spin."""
    if wait.block.recursive:
        return 'a function that calls itself'
    words = {
        BUSY_WAIT: 'a busy loop',
        SPIN_FOR_FUTURE: 'a nested spin',
        'polling loop': 'a polling loop',
        WORKING_LOOP: 'its loop',
        ANSWER_LOOP: 'a loop for an answer',
    }
    return words.get(wait.block.call, wait.block.call)


def how_long(wait: AnyWait, *, is_one: bool = True) -> str:
    """Say how long a wait lasts that nothing ends: forever, if it is no recursion."""
    if wait.block.recursive:
        whose = 'it' if is_one else 'them'
        return f'RecursionError ends {whose} after some {RECURSION_LIMIT:,} calls'
    return 'it waits forever' if is_one else 'they wait forever'


def how_it_ends(waits: Sequence[Wait]) -> str:
    """Say what becomes of waits that nothing can end, of callbacks at one place."""
    wait, is_one = waits[0], len(callers_of(waits)) == 1
    if wait.block.call == POLLING_LOOP:
        runs = 'it goes' if is_one else 'they go'
        return f'unless the data is there at once, {runs} on for all of its time'
    if wait.has_timeout:
        runs = 'it always times out' if is_one else 'they always time out'
        is_call = wait.block.call == _CALL
        raises = ', which from Kilted on raises TimeoutError and ends the spin if it is not caught'
        return f'{runs}{raises if is_call else ""}'
    is_event = wait.block.call == EVENT_WAIT and not is_done_callback(wait.needs[0])
    unless = ', unless the event is already set' if is_event else ''
    return how_long(wait, is_one=is_one) + unless


def at_one_place(waits: Iterable[W]) -> Iterator[tuple[W, ...]]:
    """Waits at one line, of several callbacks or for several others, in order of the first."""
    alike: dict[object, list[W]] = {}
    for wait in waits:
        alike.setdefault((wait.place, wait.block.call), []).append(wait)
    yield from map(tuple, alike.values())


def callers_of(waits: Sequence[AnyWait]) -> tuple[str, ...]:
    """Names of the callbacks that wait, each once."""
    return tuple(dict.fromkeys(wait.caller.name for wait in waits))


def are_one(waits: Sequence[AnyWait]) -> bool:
    """Whether all that wait have one name for the reader, as two timers of one function."""
    return len({called(wait.caller) for wait in waits}) == 1


def who_waits(waits: Sequence[AnyWait]) -> str:
    """Say what waits: ``drive waits``, ``drive, stop wait``."""
    names = shown(wait.caller for wait in waits)
    return f'{names} {"waits" if are_one(waits) else "wait"}'


def ways_of_others(waits: Sequence[AnyWait]) -> Iterator[Remark]:
    """Where the others than the first call what waits."""
    for wait in waits[1:]:
        yield from wait.chain[:1]
