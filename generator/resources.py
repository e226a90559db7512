"""
Waits whose wakers the specification names: what they are for, and what ends them.

A wait that time or code outside ends is not in the model, which has no clock: the callback
that waits runs on. One that unknown code may end is open: it may be left at any moment, and
it may stay until a waker that is known ends it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.generator.executor_kinds import ExecutorKind, executor_kind
from ros2cc_extract.generator.nested_spins import is_part_of_spin
from ros2cc_extract.generator.program_steps import NamedWait, Resource, WaitKind
from ros2cc_extract.identity_memo import once
from ros2cc_extract.spec.client_server_pairs import client_before, server_of
from ros2cc_extract.spec.effects import AWAIT, OUTSIDE, TIME, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Activity, Callback, CallbackType, GroupType, Spec

Actor = Callback | Activity
#: Names that stand for nothing in the unit.
_BY_ITSELF = (OUTSIDE, TIME)
# Waits for the end of a run, which nothing can wait for before it has been started: a thread that
# was not refuses to be joined, and a future of a job is made with the job.
FOR_RUNS = ('Thread.join', 'Process.join', 'Future.result', 'Future.exception', 'futures.wait')


def all_actors(spec: Spec) -> tuple[Actor, ...]:
    """Callbacks and activities, be these in the model or not."""
    return (*spec.callbacks, *spec.activities)


def goes_by_wakers(block: Blocking, spec: Spec) -> bool:
    """
    Return whether a specification says what ends a wait.

    An answer comes from the client that is asked, even if others are named.
    """
    is_named = block.resource is not None or block.wakers or block.escapes is not None
    if not is_named or is_foreign(block, spec):
        return False
    asked = _by_name(spec).get(block.on) if isinstance(block.on, str) else None
    is_client = asked is not None and asked.type is CallbackType.CLT
    return not is_client or asked is None or client_before(asked, spec.callbacks) is not None


@once
def _by_name(spec: Spec) -> Mapping[str, Callback]:
    return {callback.name: callback for callback in spec.callbacks}


def is_foreign(block: Blocking, spec: Spec) -> bool:
    """
    Return whether only a thread of the user's own completes what is awaited.

    How the events executor goes on then was not read.
    """
    is_ours = executor_kind(spec) is not ExecutorKind.EVENTS
    is_await = block.call == AWAIT and block.seconds is None
    return is_await and block.foreign and is_ours


def may_pass_unseen(block: Blocking, callback: Callback, spec: Spec) -> bool:
    """
    Return whether a lap may ask the coroutine before the task has ended, and none follows.

    In a pool they run at the same time. On one thread the work of an entity makes two laps
    begin, and each asks the coroutines in turn: it takes two tasks, one ended by the other, of
    which each is asked after what waits for it, as one that was made before.
    """
    kind = executor_kind(spec)
    enders = [ender for ender in _tasks_that_end(block, spec) if ender.name != callback.name]
    if kind is not ExecutorKind.SINGLE_THREADED:
        return kind is ExecutorKind.MULTI_THREADED and bool(enders)
    late = [ender for ender in enders if not _is_made_within(ender, callback, block)]
    return any(
        not _is_made_within(first, ender, own)
        for ender in late
        for own in ender.blocking
        for first in _tasks_that_end(own, spec)
    )


def _tasks_that_end(block: Blocking, spec: Spec) -> Iterator[Callback]:
    if block.call == AWAIT and block.seconds is None:
        on = block.on if isinstance(block.on, str) else None
        named = {on, *(waker.by for waker in block.wakers)}
        for callback in spec.callbacks:
            if callback.name in named and callback.entity is not None and callback.entity.is_task:
                yield callback


def _is_made_within(task: Callback, callback: Callback, block: Blocking) -> bool:
    """Return whether a run makes the task before it awaits it, by lines: it is asked before."""
    begin, made, end = callback.defined, task.source, block.source
    if begin is None or made is None or end is None:
        return False
    return begin.file == made.file == end.file and begin.line <= made.line <= end.line


def resource_waits(block: Blocking, callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    """Give the waits that stand for one; several where every waker is needed."""
    if block.seconds is not None or _ends_by_itself(block):
        return
    is_await = block.suspends and isinstance(callback, Callback)
    kind = WaitKind.AWAITED if is_await else WaitKind.HELD
    known = _known(spec)
    is_open = _is_open(block, spec)
    client = None if is_open else _asked_before(block, callback, spec)
    if client is not None:
        yield NamedWait(client.name, kind)
    if not is_open and _must_run_once_more(block, callback, spec):
        by = tuple(dict.fromkeys(waker.by for waker in block.wakers))
        yield NamedWait(callback.name, kind, resource=private_resource(block, callback), wakers=by)
        return
    for resource, wakers in _resources_of(block, callback, spec):
        by = tuple(dict.fromkeys(waker.by for waker in wakers if waker.by in known))
        yield NamedWait(
            by[0] if by else callback.name,
            kind,
            resource=resource,
            begun=_begun(block, wakers, spec),
            may_skip=is_open,
            is_open=is_open,
            wakers=by,
        )


def _ends_by_itself(block: Blocking) -> bool:
    """Return whether time or code outside ends it; if all wakers are needed, whether all do."""
    by_itself = [waker.by in _BY_ITSELF for waker in block.wakers]
    return all(by_itself) and bool(by_itself) if block.needs is Needs.ALL else any(by_itself)


def _begun(block: Blocking, wakers: tuple[Waker, ...], spec: Spec) -> tuple[Resource, ...]:
    """Give the starts of what ends a wait by its own end; none where it may be there before."""
    if block.call not in FOR_RUNS or any(waker.after is not None for waker in wakers):
        return ()
    ended = {waker.by for waker in wakers}
    runs = [activity for activity in spec.activities if activity.name in ended]
    if any(start.after is None for run in runs for start in run.starts):
        return ()  # it is handed over before, and begins when its starter has ended
    starts = [start_of(run, spec) for run in runs]
    found = tuple(start for start in starts if start is not None)
    return found if len(found) == len(ended) else ()


def ends_outside(block: Blocking, spec: Spec) -> bool:
    """Return whether a wait is taken to end because code outside may end it."""
    is_outside = any(waker.by == OUTSIDE for waker in block.wakers)
    return goes_by_wakers(block, spec) and block.seconds is None and is_outside


def is_left_open(block: Blocking, spec: Spec) -> bool:
    """Return whether it is unknown what may end a wait."""
    is_timed = block.seconds is not None or _ends_by_itself(block)
    return goes_by_wakers(block, spec) and not is_timed and _is_open(block, spec)


def _is_open(block: Blocking, spec: Spec) -> bool:
    known = _known(spec).union(_BY_ITSELF)
    is_unknown = block.escapes is not None or any(w.by not in known for w in block.wakers)
    return is_unknown or may_be_used_up(block, spec) or _goes_by_data(block, spec)


def _goes_by_data(block: Blocking, spec: Spec) -> bool:
    """Of callbacks alone: a thread that waits for work in this way is idle, and need not go on."""
    return block.goes_by_data and any(block in each.blocking for each in spec.callbacks)


def may_be_used_up(block: Blocking, spec: Spec) -> bool:
    """
    Return whether waits that end without a signal may all have been used by earlier runs.

    The model lets data arrive too seldom for that. Code that gives back what it takes itself uses
    up nothing.
    """
    if block.initial <= 0 or block.counted:
        return False
    waiting = {actor.name for actor in all_actors(spec) if block in actor.blocking}
    return waiting.isdisjoint(waker.by for waker in block.wakers)


@once
def _known(spec: Spec) -> frozenset[str]:
    """Names of those whose signals the model has."""
    activities = (a.name for a in spec.activities if a.unresolved is None)
    return frozenset((*(callback.name for callback in spec.callbacks), *activities))


def signals_of(callback: Actor, spec: Spec) -> Iterator[NamedWait]:
    """
    Give the signals by which a callback ends waits, each at its place among its own waits.

    It starts activities by signals too.
    """
    for resource, waker in _signals(spec).get(callback.name, ()):
        yield _signal(resource, waker, callback)


@once
def _signals(spec: Spec) -> Mapping[str, Sequence[tuple[Resource, Waker]]]:
    """What each callback and activity ends, starts of activities first."""
    found: dict[str, list[tuple[Resource, Waker]]] = {}
    for activity in spec.activities:
        start = start_of(activity, spec)
        for waker in activity.starts:
            if start is not None:
                found.setdefault(waker.by, []).append((start, waker))
    ordered: dict[object, tuple[list[tuple[Resource, Waker]], int]] = {}
    for waiting in all_actors(spec):
        for block in waiting.blocking:
            is_spin = isinstance(waiting, Callback) and is_part_of_spin(block, waiting)
            is_wait = block.wakers and goes_by_wakers(block, spec) and not is_spin
            if not is_wait or not any(resource_waits(block, waiting, spec)):
                continue
            for resource, wakers in _resources_of(block, waiting, spec):
                for waker in wakers:
                    key = (waker.by, resource, waker.after, waker.source, waker.held)
                    if key not in ordered:
                        own = found.setdefault(waker.by, [])
                        ordered[key] = own, len(own)
                        own.append((resource, waker))
                    elif waker.conditional:
                        # It may be kept from the one wait and not from the other.
                        own, place = ordered[key]
                        own[place] = resource, waker
    return found


def start_of(activity: Activity, spec: Spec) -> Resource | None:
    """
    Give what starts an activity; ``None`` where it runs from the beginning, or may.

    One that does nothing for others is not started, as models do not have it.
    """
    known = _known(spec)
    is_known = all(waker.by in known for waker in activity.starts)
    if not activity.starts or not is_known or not concerns_others(activity, spec):
        return None
    return Resource(f'start of {activity.name}', is_each=not activity.loops)


def concerns_others(activity: Activity, spec: Spec) -> bool:
    """Return whether an activity waits, takes locks, ends a wait or starts another one."""
    if activity.unresolved is not None:
        return False
    return bool(activity.blocking or activity.locks) or activity.name in _wake_or_start(spec)


@once
def _wake_or_start(spec: Spec) -> frozenset[str]:
    """What ends waits of others, or starts activities."""
    blocks = (block for actor in all_actors(spec) for block in actor.blocking)
    wakers = {w.by for block in blocks if goes_by_wakers(block, spec) for w in block.wakers}
    return frozenset(wakers | {waker.by for other in spec.activities for waker in other.starts})


def _signal(resource: Resource, waker: Waker, callback: Actor) -> NamedWait:
    waits = len(callback.blocking)
    return NamedWait(
        callback.name,
        WaitKind.SIGNAL,
        resource=resource,
        may_skip=waker.conditional,
        origin=waits if waker.after is None else min(waker.after, waits),
        waker=waker,
    )


def _resources_of(
    block: Blocking, callback: Actor, spec: Spec
) -> Iterator[tuple[Resource, tuple[Waker, ...]]]:
    """What a wait is for; a resource of its own for each waker where all of them are needed."""
    name = block.resource
    if name is None:
        name = f'{callback.name} {callback.blocking.index(block)}'
    given = _givers(block, callback, spec)
    if block.needs is Needs.ALL:
        for waker in (each for each in given if each.by not in _BY_ITSELF):
            after = 'end' if waker.after is None else waker.after
            yield Resource(f'{name} by {waker.by} {after}', is_each=False), (waker,)
        if given:
            return
    is_each = block.needs is Needs.EACH
    # Of what is left after other runs nothing is known, but that it is no more.
    has_some = is_each and block.escapes is None and not may_be_used_up(block, spec)
    initial = block.initial if has_some else 0
    by = (replace(waker, conditional=False) for waker in given)
    yield (
        Resource(
            name,
            is_each,
            initial,
            forgets=is_each and block.forgets,
            least=1 if is_each else block.signals,
            given_by=frozenset() if is_each else frozenset(by),
        ),
        given,
    )


def _givers(block: Blocking, callback: Actor, spec: Spec) -> tuple[Waker, ...]:
    """
    Give what ends a wait, with what answers a done-callback in place of the done-callback.

    Nothing calls a done-callback before its client has taken the answer, and no answer comes
    before the service of the unit has sent it. Where the wait asks the client itself, that is so.
    """
    is_asked = not _is_open(block, spec) and _asked_before(block, callback, spec) is not None
    if is_asked:
        return block.wakers
    return tuple(_in_place_of(waker, callback, spec) for waker in block.wakers)


def _in_place_of(waker: Waker, waiting: Actor, spec: Spec) -> Waker:
    done = _by_name(spec).get(waker.by)
    client = client_before(done, spec.callbacks) if done is not None else None
    if done is None or client is None or waiting in (client, done):
        return waker
    server = server_of(client, spec.callbacks)
    first = client
    if server is not None and not _shares_group(client, waiting, spec):
        first = server if _may_be_held(server, waiting, spec) else client
    is_sure = not done.blocking and not done.locks
    return replace(
        waker, by=first.name, after=None, conditional=waker.conditional or not is_sure, held=()
    )


def _may_be_held(server: Callback, waiting: Actor, spec: Spec) -> bool:
    """Return whether a server may not come to its end while a callback waits."""
    return bool(server.blocking) or _shares_group(server, waiting, spec)


def _shares_group(one: Callback, other: Actor, spec: Spec) -> bool:
    if isinstance(other, Activity):
        return False
    is_exclusive = spec.group_of(one).type is GroupType.EXCLUSIVE
    return is_exclusive and one.group == other.group


def _must_run_once_more(block: Blocking, callback: Actor, spec: Spec) -> bool:
    """
    Return whether nothing ends a wait before its callback, in an exclusive group, runs again.

    So does a feedback callback that waits for what comes with the result: its client takes both.
    """
    if not isinstance(callback, Callback) or not block.wakers:
        return False
    by_name = {c.name: c for c in spec.callbacks}
    wakers = [by_name.get(waker.by) for waker in block.wakers]
    is_exclusive = spec.group_of(callback).type is GroupType.EXCLUSIVE
    return is_exclusive and all(
        waker is not None and client_before(waker, spec.callbacks) == callback for waker in wakers
    )


def private_resource(block: Blocking, callback: Actor) -> Resource:
    """What an unknown wait is for."""
    return Resource(f'{callback.name} {callback.blocking.index(block)}', is_each=False)


def _asked_before(block: Blocking, callback: Actor, spec: Spec) -> Callback | None:
    """
    Give the client that must have its answer first.

    Done-callbacks run after it: where all wakers are done-callbacks of one client, it is asked.
    """
    by_name = {c.name: c for c in spec.callbacks}
    wakers = [by_name[waker.by] for waker in block.wakers if waker.by in by_name]
    clients = [client_before(waker, spec.callbacks) for waker in wakers]
    first = clients[0] if clients else None
    if first is None or first == callback or any(client != first for client in clients):
        return None
    return first
