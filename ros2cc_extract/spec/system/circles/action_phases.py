"""
The two answers of an action, distinguished where processes are put into one unit.

Code that sends a goal and waits for its end waits for two answers, one after the other: that the
goal is accepted, which the action server gives in its own group, and the result, which is there
once the execute callback has ended. Each is as the answer of a service. Source: rclpy 7.1.6,
``action/client.py`` (``send_goal`` calls ``send_goal_async`` and then ``get_result_async``),
``action/server.py`` (``execute`` is a task of the executor, in no group).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.spec.client_server_pairs import reachable
from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.joined_executors import enders_of
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    EntityKind,
    GroupType,
    Spec,
)
from ros2cc_extract.spec.system.circles.rewritten_waits import with_waits

_WHOLE = 'send_goal'
"""The call that waits for both."""
_ONE_GOAL = 'one_goal_of_{}'
_GOAL, _RESULT = 'goal of {}', 'result of {}'


def with_phases(parts: Sequence[Spec]) -> list[Spec]:
    """Distinguish them for each action whose ends are both followed; others stay as they are."""
    keys = _keys(parts)
    sure = frozenset(key for part in parts for key in _sure_goals(part))
    certain = frozenset(key for part in parts for key in _sure_results(part)) - sure
    clients = {
        callback.name: callback
        for part in parts
        for callback in part.callbacks
        if callback.entity is EntityKind.ACTION_CLIENT and callback.key in keys
    }
    taken = {name for part in parts for name in part.names()}
    second = {name: _free(f'{name}_result', taken) for name in clients}
    left_out = {
        name
        for callback in clients.values()
        for name, keys_of in ((callback.name, sure), (second[callback.name], certain))
        if callback.key in keys_of
    }
    waiting = with_waits(parts, lambda _, block: _both(block, second, left_out))
    return [_split(part, keys, second, left_out) for part in waiting]


def _sure_goals(part: Spec) -> Iterator[object]:
    """The actions whose goals are always accepted: their group is never held."""
    if len(part.executor.threads) < 2:
        return
    held = {each.group for each in part.callbacks if each.blocking or each.locks}
    for callback in part.callbacks:
        if callback.entity is EntityKind.ACTION_SERVER and callback.group not in held:
            yield callback.key


def _sure_results(part: Spec) -> Iterator[object]:
    """The actions whose execute callback waits for nothing."""
    if len(part.executor.threads) < 2:
        return
    for callback in part.callbacks:
        is_free = not callback.blocking and not callback.locks
        if callback.entity is EntityKind.ACTION_EXECUTE and is_free:
            yield callback.key


def _keys(parts: Sequence[Spec]) -> frozenset[str]:
    """The actions whose answers can be distinguished."""
    callbacks = [callback for part in parts for callback in part.callbacks]
    executed = _named(callbacks, EntityKind.ACTION_EXECUTE)
    served = _named(callbacks, EntityKind.ACTION_SERVER)
    clients = {c.name: c for c in callbacks if c.entity is EntityKind.ACTION_CLIENT}
    other = {key for part in parts for key in _asked_otherwise(part, clients)}
    return frozenset((executed & served) - other)


def _named(callbacks: Iterable[Callback], kind: EntityKind) -> set[str]:
    """Those that exist once."""
    found = [c.key for c in callbacks if c.entity is kind and isinstance(c.key, str)]
    return {key for key in found if found.count(key) == 1}


def _asked_otherwise(part: Spec, clients: Mapping[str, Callback]) -> Iterable[str]:
    """The actions of which code waits for one answer only, whichever that is."""
    doers: tuple[Callback | Activity, ...] = (*part.callbacks, *part.activities)
    for block in (block for doer in doers for block in doer.blocking):
        client = clients.get(block.on) if isinstance(block.on, str) else None
        is_other = block.call.rpartition('.')[2] not in (_WHOLE, 'wait_for_server')
        if client is not None and is_other and isinstance(client.key, str):
            yield client.key


def _split(
    part: Spec, keys: frozenset[str], second: Mapping[str, str], left_out: Collection[str]
) -> Spec:
    """
    Return a unit with the ends of ``keys`` split.

    :param second: what takes the second answer, by what takes the first.
    :param left_out: of both, those whose answers need no wait.
    """
    taken = {*part.names(), *second.values()}
    callbacks: list[Callback] = []
    groups = list(part.groups)
    for callback in part.callbacks:
        key = callback.key if callback.key in keys else None
        if key is None:
            callbacks.append(callback)
        elif callback.entity is EntityKind.ACTION_CLIENT:
            both = _clients(callback, second[callback.name])
            callbacks += [each for each in both if each.name not in left_out]
        elif callback.entity is EntityKind.ACTION_EXECUTE:
            name = _free(_ONE_GOAL.format(callback.name), taken)
            groups.append(CallbackGroup(name=name, type=GroupType.EXCLUSIVE))
            server = replace(callback, entity=EntityKind.SERVICE, key=_RESULT.format(key))
            callbacks.append(replace(server, group=name, groupless=False))
        elif callback.entity is EntityKind.ACTION_SERVER:
            server = replace(callback, entity=EntityKind.SERVICE, key=_GOAL.format(key))
            callbacks.append(server)
        else:
            callbacks.append(callback)
    used = {callback.group for callback in callbacks}
    return replace(
        part,
        callbacks=tuple(callbacks),
        groups=tuple(group for group in groups if group.name in used),
    )


def needs_itself(whole: Spec) -> str | None:
    """The first execute callback that waits for another goal of its own action, by its action."""
    doers: tuple[Callback | Activity, ...] = (*whole.callbacks, *whole.activities)
    ahead = {
        doer.name: {name for block in doer.blocking for name in enders_of(block, whole)}
        for doer in doers
    }
    for callback in whole.callbacks:
        is_one = callback.group.startswith(_ONE_GOAL.format(''))
        if is_one and callback.name in reachable(callback.name, ahead):
            return str(callback.key)
    return None


def _clients(callback: Callback, name: str) -> list[Callback]:
    client = replace(callback, entity=EntityKind.CLIENT)
    return [
        replace(client, key=_GOAL.format(callback.key)),
        replace(client, name=name, key=_RESULT.format(callback.key)),
    ]


def _both(
    block: Blocking, second: Mapping[str, str], left_out: Collection[str]
) -> tuple[Blocking, ...]:
    """A wait for a whole action as two, one behind the other."""
    on = block.on if isinstance(block.on, str) else ''
    if on not in second or block.call.rpartition('.')[2] != _WHOLE:
        return (_for(block, on, second[on]) if on in left_out else block,)
    return tuple(_for(block, on, name) for name in (on, second[on]) if name not in left_out)


def _for(block: Blocking, on: str, name: str) -> Blocking:
    """The wait of ``on`` as one for ``name``."""
    wakers = tuple(Waker(by=name) if each.by == on else each for each in block.wakers)
    resource = name if block.resource == on else block.resource
    return replace(block, on=name, resource=resource, wakers=wakers)


def _free(name: str, taken: set[str]) -> str:
    while name in taken:
        name += '_'
    taken.add(name)
    return name
