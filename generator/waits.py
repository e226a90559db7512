"""
Which callbacks of the unit must run before a running callback can go on.

Source: rclpy 7.1.6, ``client.py`` (``call`` waits for an event that is set when the executor has
run the client), ``action/client.py``, ``timer.py`` (``Rate``); ``threading.Event.wait``;
``task.py`` (``await`` suspends the handler, ``callback_groups.py`` ends it only when it is done).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind
from ros2cc_extract.generator.nested_spins import is_open, is_part_of_spin, is_spin, nested_spins
from ros2cc_extract.generator.program_steps import Lock, NamedWait, WaitKind
from ros2cc_extract.generator.resources import (
    Actor,
    all_actors,
    concerns_others,
    goes_by_wakers,
    is_foreign,
    may_pass_unseen,
    private_resource,
    resource_waits,
    signals_of,
)
from ros2cc_extract.identity_memo import known_of, once
from ros2cc_extract.spec.client_server_pairs import (
    client_before,
    is_client,
    server_of,
    servers_of,
)
from ros2cc_extract.spec.effects import RE_ENTRANT, TURN, Blocking
from ros2cc_extract.spec.model import Activity, Callback, GroupType, Spec
from ros2cc_extract.spec.releases.table import FUTURE_YIELDS_ITSELF

_ASKS_THE_GRAPH = ('wait_for_service', 'wait_for_server')
# They end by themselves, even where it is not known when.
_PAUSES = ('time.sleep', 'asyncio.sleep', TURN)


def waits_of(callback: Actor, spec: Spec) -> tuple[NamedWait, ...]:
    """
    List the waits that others end; one with a time-out ends by itself, unless it spins.

    A callback that waits for a service that nobody offers does so last, if nobody waits for
    what it does afterwards: what else may hold the callback is then seen without it. Signals for
    waits of others stand among the waits.
    """
    known = known_of(spec).setdefault(waits_of, {})
    if id(callback) not in known:
        # Kept with its callback, so that no other one gets its number.
        known[id(callback)] = callback, tuple(_with_ways(tuple(_waits_of(callback, spec))))
    found: tuple[NamedWait, ...] = known[id(callback)][1]
    return found


def _with_ways(steps: Sequence[NamedWait]) -> Iterator[NamedWait]:
    """Let a branch that skips a signal skip the waits that come only behind it."""
    for number, step in enumerate(steps):
        until = step.waker.until if step.is_signal and step.may_skip and step.waker else None
        past = number + 1
        while past < len(steps) and _is_inside(steps[past], until):
            past += 1
        yield step if past == number + 1 else replace(step, past=past)


def _is_inside(step: NamedWait, until: int | None) -> bool:
    is_wait = step.block is not None and not step.is_signal
    return until is not None and is_wait and step.origin < until


def _waits_of(callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    others, absent = tuple(_for_others(callback, spec)), tuple(_for_absent(callback, spec))
    signals = tuple(signals_of(callback, spec))
    if signals:
        others, absent = _with_signals((*others, *absent), signals, spec, callback), ()
    locks = _contended_locks(spec)
    kept = {lock for wait in (*others, *absent) for lock in wait.held}
    looked_into = [lock for lock in _taken_locks(callback) if lock in locks - kept]
    ends = tuple(wait for wait in others if _is_end(wait, callback))
    if len(ends) < len(signals):
        first = [lock for lock in looked_into if _is_before(lock, signals)]
        for lock in looked_into:
            # Whether it takes others before its signals is not known.
            doubt = lock not in first
            yield NamedWait(
                callback.name, WaitKind.LOCKED, lock=lock, may_skip=doubt, is_open=doubt
            )
        looked_into = [lock for lock in looked_into if lock not in first]
    yield from _with_locks((wait for wait in others if wait not in ends), callback, locks)
    for lock in looked_into:
        yield NamedWait(callback.name, WaitKind.LOCKED, lock=lock)
    yield from ends
    yield from _with_locks(absent, callback, locks)


def _is_before(lock: Lock, signals: Iterable[NamedWait]) -> bool:
    """Whether the lock has surely been taken when the first of the signals comes."""
    wakers = [signal.waker for signal in signals]
    return all(waker is not None and lock.name in waker.passed for waker in wakers)


def _is_end(wait: NamedWait, actor: Actor) -> bool:
    """Whether a step is the signal that a thread gives by its end, behind all that it does."""
    waker = wait.waker if wait.is_signal else None
    return isinstance(actor, Activity) and waker is not None and waker.after is None


def _with_signals(
    waits: Iterable[NamedWait], signals: Iterable[NamedWait], spec: Spec, callback: Actor
) -> tuple[NamedWait, ...]:
    """Put each signal behind the waits that the callback has behind it then."""
    has_pool = executor_kind(spec) is ExecutorKind.MULTI_THREADED
    placed = [
        replace(signal, held=tuple(_locks_of(signal.waker.held, has_pool)))
        for signal in signals
        if signal.waker is not None
    ]
    return tuple(sorted((*placed, *waits), key=lambda step: (step.origin, not step.is_signal)))


def _for_others(callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    spins = tuple(nested_spins(callback, spec)) if isinstance(callback, Callback) else ()
    for place, block in enumerate(callback.blocking):
        held = _held_locks(block, callback, spec)
        of_block: list[NamedWait] = []
        if not _is_of_spin(block, callback):
            of_block.extend(_waits_for_callbacks(block, callback, spec))
        for spun, spin in spins:
            if spun is block and spin is not None:
                of_block.append(NamedWait(spin.needed or callback.name, WaitKind.SPUN, spin))
        for wait in of_block:
            yield replace(
                wait,
                held=held,
                origin=place,
                block=block,
                may_skip=wait.may_skip or block.conditional,
            )


def _for_absent(callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    if isinstance(callback, Activity):
        return  # assumed: a node outside offers it
    for place, block in enumerate(callback.blocking):
        if is_absent(block, spec) and isinstance(block.on, str):
            held = _held_locks(block, callback, spec)
            yield NamedWait(block.on, WaitKind.ABSENT, held=held, origin=place, block=block)


def _waits_for_callbacks(block: Blocking, callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    others = {other.name: other for other in spec.callbacks if other.name != callback.name}
    needed = others.get(block.on) if isinstance(block.on, str) else None
    if isinstance(callback, Activity) and is_unknown(block, callback, spec):
        resource = private_resource(block, callback)
        yield NamedWait(
            callback.name, WaitKind.HELD, resource=resource, may_skip=True, is_open=True
        )
        return
    is_callback = isinstance(callback, Callback)
    if is_callback and (is_foreign(block, spec) or _gives_way(block)):
        yield NamedWait(callback.name, WaitKind.FOREIGN)
    elif goes_by_wakers(block, spec):
        yield from resource_waits(block, callback, spec)
        return
    if needed is None or block.seconds is not None or asks_the_graph(block):
        return
    kind = WaitKind.AWAITED if block.suspends and is_callback else WaitKind.HELD
    client = client_before(needed, spec.callbacks)
    if client is not None and client.name in others:
        yield NamedWait(client.name, kind)
    yield NamedWait(needed.name, kind)


def _gives_way(block: Blocking) -> bool:
    """
    Return whether others run meanwhile, though time ends it.

    That matters where they are kept out of something.
    """
    return block.suspends and block.is_timed and bool(block.held)


def _with_locks(
    waits: Iterable[NamedWait], callback: Actor, locks: frozenset[Lock]
) -> Iterator[NamedWait]:
    """Put the taking of each lock before the first of the waits that hold it."""
    before: tuple[Lock, ...] = ()
    for wait in waits:
        held = tuple(lock for lock in wait.held if lock in locks)
        kept = tuple(lock for lock in held if lock in before)
        for lock in held:
            if lock not in kept:
                yield NamedWait(callback.name, WaitKind.LOCKED, lock=lock, held=kept)
                kept = (*kept, lock)
        yield replace(wait, held=held)
        before = held


@once
def _contended_locks(spec: Spec) -> frozenset[Lock]:
    """Locks that some callback holds while it waits for others, and that another run takes."""
    actors = [a for a in all_actors(spec) if isinstance(a, Callback) or concerns_others(a, spec)]
    if not any(block.held for actor in actors for block in actor.blocking):
        return frozenset()
    holders: dict[Lock, set[str]] = {}
    takers: dict[Lock, set[str]] = {}
    for callback in actors:
        waits = (*_for_others(callback, spec), *_for_absent(callback, spec))
        held = {lock for wait in waits for lock in wait.held}
        for lock in held:
            holders.setdefault(lock, set()).add(callback.name)
        signals = _with_signals((), signals_of(callback, spec), spec, callback)
        held_to_signal = {lock for signal in signals for lock in signal.held}
        for lock in held.union(_taken_locks(callback), held_to_signal):
            takers.setdefault(lock, set()).add(callback.name)
    overlapping = {
        c.name for c in spec.callbacks if spec.group_of(c).type is not GroupType.EXCLUSIVE
    }
    return frozenset(
        lock for lock, who in holders.items() if len(takers[lock]) > 1 or who & overlapping
    )


def _taken_locks(callback: Actor) -> tuple[Lock, ...]:
    """Locks that it waits for; one that it only tries to take does not hold it."""
    taken = (act.name for act in callback.locks if not act.tries)
    return tuple(dict.fromkeys(Lock(name) for name in taken if isinstance(name, str)))


def _held_locks(block: Blocking, callback: Actor, spec: Spec) -> tuple[Lock, ...]:
    """
    Locks that are held over a wait and keep out all others that take them.

    One that its holder may take again keeps out other threads: an executor of one thread has
    none, and which thread goes on after an ``await``, or runs what a nested spin finds, is open.
    """
    has_pool = executor_kind(spec) is ExecutorKind.MULTI_THREADED
    keeps_out = has_pool and not block.suspends and not _is_of_spin(block, callback)
    return tuple(_locks_of(block.held, keeps_out))


def _locks_of(held: Iterable[str], keeps_out: bool) -> Iterator[Lock]:
    for name in held:
        if keeps_out or not name.endswith(RE_ENTRANT):
            yield Lock(name.removesuffix(RE_ENTRANT))


def _is_of_spin(block: Blocking, actor: Actor) -> bool:
    return isinstance(actor, Callback) and is_part_of_spin(block, actor)


def is_unknown(block: Blocking, activity: Activity, spec: Spec) -> bool:
    """Return whether it is unknown what ends a wait of an activity; of a spin it always is."""
    if is_spin(block):
        return True
    others = {other.name for other in spec.callbacks if other.name != activity.name}
    has_partner = isinstance(block.on, str) and block.on in others
    is_pause = block.call in _PAUSES or block.seconds is not None or asks_the_graph(block)
    return not is_pause and not has_partner and not goes_by_wakers(block, spec)


def modelled_activities(spec: Spec) -> Iterator[Activity]:
    """Return the activities that something depends on, or that wait themselves."""
    for activity in spec.activities:
        if concerns_others(activity, spec) and any(waits_of(activity, spec)):
            yield activity


def actors_of(spec: Spec) -> Iterator[Actor]:
    """Callbacks and activities, as models number them."""
    yield from spec.callbacks
    yield from modelled_activities(spec)


def unknown_ends(callback: Callback, spec: Spec) -> Iterator[Blocking]:
    """What may hold a callback forever, or let others run inside it, and is in no model."""
    yield from (block for block, spin in nested_spins(callback, spec) if is_open(spin))
    others = {other.name: other for other in spec.callbacks if other.name != callback.name}
    for block in callback.blocking:
        partner = others.get(block.on) if isinstance(block.on, str) else None
        if is_part_of_spin(block, callback) or block.call in _PAUSES or block.seconds is not None:
            continue
        if is_unseen(block, callback, spec):
            yield block
            continue
        if is_foreign(block, spec) or is_absent(block, spec) or goes_by_wakers(block, spec):
            continue
        is_there = partner is not None and server_of(partner, spec.callbacks) is not None
        if not is_there if asks_the_graph(block) else partner is None:
            yield block


def foreign_wakes(spec: Spec) -> bool:
    """
    Return whether a thread of the user's own that makes a future done wakes the executor.

    A loop of asyncio, to which the thread has to hand it over, is always woken. Before, a lap of
    an executor asks every coroutine whether it can go on, and nothing but a lap (``task.py``,
    ``Future.__await__``, of 7.1.6 and 9.1.2; then of 3.3.21, 7.1.9 and 9.1.5).
    """
    is_loop = executor_kind(spec) is ExecutorKind.ASYNCIO
    return is_loop or FUTURE_YIELDS_ITSELF.holds(spec.rclpy) is True


def is_unseen(block: Blocking, callback: Callback, spec: Spec) -> bool:
    """
    Return whether what ends an await may pass unseen, so that only another event makes it go on.

    So may the end of a task where no future wakes the executor: only the work of an entity
    triggers its guard (rclpy 7.1.6 and 9.1.2, ``executors.py``, ``_make_handler``). The model has
    the executor woken there.
    """
    return not foreign_wakes(spec) and may_pass_unseen(block, callback, spec)


def is_absent(block: Blocking, spec: Spec) -> bool:
    """
    Return whether a wait without a time-out is for a service that nobody in the unit offers.

    Where a callback waits for an answer of that client, a node outside answers, and is there.
    """
    if not asks_the_graph(block) or block.seconds is not None:
        return False
    client = next((c for c in spec.callbacks if c.name == block.on), None)
    if client is None:
        return False
    is_asked = client.name in _asked_for_answers(spec)
    return is_client(client) and not is_asked and not servers_of(client, spec.callbacks)


@once
def _asked_for_answers(spec: Spec) -> frozenset[str]:
    """The partners that callbacks wait for, other than waits until a service is there."""
    blocks = (block for callback in spec.callbacks for block in callback.blocking)
    return frozenset(b.on for b in blocks if isinstance(b.on, str) and not asks_the_graph(b))


def asks_the_graph(block: Blocking) -> bool:
    """Waiting for a service to be there needs no callback to run."""
    return block.call.rpartition('.')[2].startswith(_ASKS_THE_GRAPH)
