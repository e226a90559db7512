"""Waits of code that is no callback: noted here, and since when all was followed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.accesses.held_locks import held_over
from ros2cc_extract.extract.static.concurrency.machine.state import (
    ConcurrentWorld,
    OutsideWait,
    Over,
    SetUpWait,
    TimedJoin,
)
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import EntityRef
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.extract.static.python.machine.waitable_objects import is_of_loop
from ros2cc_extract.extract.static.python.values.exclusive_paths import is_behind
from ros2cc_extract.extract.static.python.values.values import Instance, Value
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import AWAIT, POLLING_LOOP, Blocking
from ros2cc_extract.spec.model import When

JOIN = 'Thread.join'
_SIGINT = frozenset({'KeyboardInterrupt', 'BaseException'})
RATE = 'Rate.sleep'
ANSWERS = frozenset(['client.call', 'send_goal', 'get_result', 'busy wait'])
_FUTURES = frozenset(['client', 'goal', 'result', 'cancel', 'future', 'task'])

# Waits for objects that nothing but the program ends, by their kinds.
_PLAIN = {
    'Event.wait': ('event',),
    'Condition.wait': ('condition',),
    'Condition.wait_for': ('condition',),
    'Queue.get': ('queue',),
    'spin_until_future_complete': ('future',),
}

_ASYNCIO_AWAIT = 'asyncio-await'


def in_words(call: str) -> str:
    """Name a wait in a sentence."""
    return 'a busy loop' if call == 'busy wait' else call


def _last(name: str) -> str:
    return name if name in _PLAIN else name.rpartition('.')[2]


def note(
    world: ConcurrentWorld, name: str, on: Instance, place: Place, spun: tuple[Instance, ...]
) -> None:
    """Remember a wait of the program's set-up."""
    if world.when is not When.START or world.after_spin:
        return
    state = on.state
    if name == 'await' and isinstance(state, PlainState) and state.kind in _FUTURES:
        world.diagnostics.append(_awaited_by_asyncio(place))
    source = state.of if isinstance(state, PlainState) and state.of is not None else on
    client = source.state if isinstance(source, Instance) else None
    if not isinstance(client, Doer):
        is_plain = isinstance(state, PlainState) and state.kind in _PLAIN.get(_last(name), ())
        if is_plain and world.is_program:
            _remember(world, name, on, place, spun)
        return
    if name == RATE:
        _remember(world, name, client, place, ())
    if not client.is_answered:
        return
    if name in ANSWERS or name.endswith('spin_until_future_complete'):
        _remember(world, name, client, place, spun)


def note_messages(world: ConcurrentWorld, name: str, brings: Doer, place: Place) -> None:
    """The set-up waits for what the messages of a subscription bring."""
    if world.when is When.START and not world.after_spin and world.is_program:
        _remember(world, name.replace(POLLING_LOOP, 'a polling loop'), brings, place, ())


def note_in_loop(world: ConcurrentWorld, awaited: Value, place: Place) -> None:
    """Report a callback that asyncio runs and that awaits what only an executor understands."""
    state = awaited.state if isinstance(awaited, Instance) else None
    if isinstance(state, PlainState) and state.kind in _FUTURES and not world.second_pass:
        world.diagnostics.append(_awaited_by_asyncio(place))


def _remember(
    world: ConcurrentWorld,
    name: str,
    on: Doer | Instance,
    place: Place,
    spun: tuple[Instance, ...],
) -> None:
    # Threads are followed where they are started; what a thread waits for has no place among them.
    begun = None if world.in_thread or world.open_loops else world.spins_begun
    wait = OutsideWait(name, on, place, world.in_thread, spun, begun=begun, path=world.path)
    world.outside.append(wait)


def note_interruptible(world: ConcurrentWorld, name: str, on: Value | None) -> None:
    """
    Remember on what the main program may wait for the signal that ends it.

    An event that nobody can set as it has no name, or one where an interruption is caught; and
    the end of a thread where just that is caught.
    Source: CPython 3.12, ``signal`` (SIGINT raises ``KeyboardInterrupt`` in the main thread).
    """
    if not isinstance(on, Instance) or world.in_thread:
        return
    is_join = name == JOIN and any(not _SIGINT.isdisjoint(names) for names in world.caught)
    if is_join or (name == 'Event.wait' and (world.caught or on.hint is None)):
        world.interruptible.add(id(on))


def note_cancelled(world: ConcurrentWorld, name: str, on: Value | None) -> None:
    """
    Remember what the main program awaits, perhaps for the signal that ends it.

    Source: CPython 3.12, ``asyncio/runners.py`` (SIGINT cancels the main task).
    """
    is_future = name == AWAIT and on is not None and is_of_loop(on)
    is_event = name.removeprefix(f'{AWAIT} ') == 'asyncio.Event.wait'
    if isinstance(on, Instance) and (is_future or is_event):
        world.interruptible.add(id(on))


def note_served(world: ConcurrentWorld, name: str, on: Value | None, place: Place) -> None:
    """
    Remember what a daemon thread waits for while it serves: the end of the program.

    What has no name nobody can set; without a lock held, nothing waits for that thread meanwhile.
    """
    doer = world.activity
    if doer is None or not doer.is_daemon or not isinstance(on, Instance) or on.hint is not None:
        return
    is_future = name == AWAIT and is_of_loop(on)
    is_event = name.removeprefix(f'{AWAIT} ') in ('asyncio.Event.wait', 'Event.wait')
    if (is_future or is_event) and not world.held:
        world.served.setdefault(id(on), place)


def note_loop(world: ConcurrentWorld, names: set[str], place: Place) -> None:
    """Remember that the set-up looks again and again whether data of ``names`` has changed."""
    is_set_up = world.when is When.START and not world.after_spin and not world.in_thread
    if is_set_up and world.is_program and not world.in_callback and not world.second_pass:
        begun = None if world.open_loops else world.spins_begun
        wait = OutsideWait('a polling loop', None, place, in_thread=False, begun=begun)
        world.outside.append(replace(wait, names=frozenset(names)))


def forget_awaits(world: ConcurrentWorld, since: int) -> None:
    """Note a coroutine without a known caller: an executor may run it."""
    late = [each for each in world.diagnostics[since:] if each.slug != _ASYNCIO_AWAIT]
    world.diagnostics[since:] = late


def _awaited_by_asyncio(place: Place) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug=_ASYNCIO_AWAIT,
        place=place,
        message='asyncio awaits an rclpy future: from rclpy 7.1.9 on this raises RuntimeError '
        'unless the future is already done',
        help='await it in a callback or an executor task, or await an asyncio future that its '
        'done-callback sets by loop.call_soon_threadsafe',
    )


def note_join(world: ConcurrentWorld, thread: Value, place: Place) -> None:
    """The program, which no executor runs, waits for the end of ``thread``."""
    is_set_up = world.effects is None or world.activity is not None
    if id(thread) in world.joined_by_exit:
        return
    if isinstance(thread, Instance) and world.is_program and is_set_up and not world.second_pass:
        is_late = world.after_spin or bool(world.spins_begun)
        wait = OutsideWait(JOIN, thread, place, world.in_thread, (), is_late, tuple(world.over))
        is_called, held = world.when is When.START, held_over(world, thread)
        world.outside.append(replace(wait, path=world.path, is_called=is_called, held=held))


def note_over(world: ConcurrentWorld, what: Value | None) -> None:
    """The program has shut ``what`` down, or waited for its end."""
    if what is None or isinstance(what, Instance):
        world.over.append(Over(what, world.path, world.spins_begun))


@contextmanager
def joined_by_exit(world: ConcurrentWorld, threads: Iterable[Value]) -> Iterator[None]:
    """Follow inside what the interpreter does when it has waited for ``threads``."""
    world.joined_by_exit = frozenset(id(each) for each in threads if isinstance(each, Instance))
    try:
        yield
    finally:
        world.joined_by_exit = frozenset()


def ended_by(world: ConcurrentWorld) -> frozenset[int]:
    """The threads that the program has surely waited for by now, by identity."""
    sure = (over.what for over in world.over if is_behind(over.path, world.path))
    return frozenset(id(what) for what in sure if what is not None) | world.joined_by_exit


def note_write(world: ConcurrentWorld, shown: str) -> None:
    """The program itself writes data that threads may look at."""
    if world.when is When.START:
        world.main_writes.setdefault(shown, []).append(ended_by(world))


def come_behind(ended: Sequence[frozenset[int]], runners: Iterable[object]) -> bool:
    """Whether all that the program does comes behind its waits for the ends of ``runners``."""
    numbers = {id(runner) for runner in runners}
    return bool(ended and numbers) and all(numbers <= each for each in ended)


def note_timed_join(world: ConcurrentWorld, thread: Value) -> None:
    """The program has waited for the end of ``thread``, but not forever."""
    if isinstance(thread, Instance):
        over = tuple(one for one in world.over if is_behind(one.path, world.path))
        world.timed_joins.append(TimedJoin(thread, world.path, over))


def note_in_set_up(
    world: ConcurrentWorld,
    block: Blocking,
    thing: Instance | None,
    place: Place,
    spun: tuple[Instance, ...] = (),
    caller: str = '',
) -> None:
    """
    Remember a wait, each once.

    :param caller: the outermost function that is followed.
    :param spun: the nodes that it spins meanwhile.
    """
    if world.second_pass:
        return
    number = block.on.number if isinstance(block.on, EntityRef) else str(block.on)
    key = (block.call, block.source, id(thing) if thing is not None else number)
    known = world.set_up.get(key)
    if known is not None and (known.by is world.activity or world.activity is not None):
        return
    begun = None if world.in_thread or world.open_loops else world.spins_begun
    outside = OutsideWait(
        block.call,
        thing,
        place,
        world.in_thread,
        spun,
        is_late=world.after_spin,
        over=tuple(world.over),
        path=world.path,
        begun=begun,
    )
    world.set_up[key] = SetUpWait(
        replace(block, chain=(), conditional=bool(world.path)),
        outside,
        uncalled=caller if world.when is When.LATER else None,
        by=world.activity,
        is_late=world.after_spin,
    )
