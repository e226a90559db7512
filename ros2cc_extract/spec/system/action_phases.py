"""
The two answers of an action, told apart where processes are put into one unit.

Whoever sends a goal and waits for its end waits for two answers, one behind the other: that the
goal is accepted, which the action server gives in its own group, and the result, which is there
once the execute callback has ended. Each is as the answer of a service. Source: rclpy 7.1.6,
``action/client.py`` (``send_goal`` calls ``send_goal_async`` and then ``get_result_async``),
``action/server.py`` (``execute`` is a task of the executor, in no group).
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

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

_WHOLE = 'send_goal'
"""The call that waits for both."""
_ONE_GOAL = 'one_goal_of_{}'
_GOAL, _RESULT = 'goal of {}', 'result of {}'


def with_phases(parts: Sequence[Spec]) -> list[Spec]:
    """Tell them apart for each action of which both ends are followed; others stay as they are."""
    keys = _keys(parts)
    return [_split(part, keys) for part in parts]


def _keys(parts: Sequence[Spec]) -> frozenset[str]:
    """The actions that can be told apart."""
    callbacks = [callback for part in parts for callback in part.callbacks]
    executed = _named(callbacks, EntityKind.ACTION_EXECUTE)
    served = _named(callbacks, EntityKind.ACTION_SERVER)
    other = {key for part in parts for key in _asked_otherwise(part)}
    return frozenset((executed & served) - other)


def _named(callbacks: Iterable[Callback], kind: EntityKind) -> set[str]:
    """Those of which there is one."""
    found = [c.key for c in callbacks if c.entity is kind and isinstance(c.key, str)]
    return {key for key in found if found.count(key) == 1}


def _asked_otherwise(part: Spec) -> Iterable[str]:
    """The actions for one of whose answers alone somebody waits, whichever that is."""
    clients = {c.name: c for c in part.callbacks if c.entity is EntityKind.ACTION_CLIENT}
    doers: tuple[Callback | Activity, ...] = (*part.callbacks, *part.activities)
    for block in (block for doer in doers for block in doer.blocking):
        client = clients.get(block.on) if isinstance(block.on, str) else None
        is_other = block.call.rpartition('.')[2] not in (_WHOLE, 'wait_for_server')
        if client is not None and is_other and isinstance(client.key, str):
            yield client.key


def _split(part: Spec, keys: frozenset[str]) -> Spec:
    second = {
        callback.name: _free(f'{callback.name}_result', part)
        for callback in part.callbacks
        if callback.entity is EntityKind.ACTION_CLIENT and callback.key in keys
    }
    callbacks: list[Callback] = []
    groups = list(part.groups)
    for callback in part.callbacks:
        callback = replace(callback, blocking=_both(callback.blocking, second))
        key = callback.key if callback.key in keys else None
        if key is None:
            callbacks.append(callback)
        elif callback.entity is EntityKind.ACTION_CLIENT:
            callbacks += _clients(callback, second[callback.name])
        elif callback.entity is EntityKind.ACTION_EXECUTE:
            name = _free(_ONE_GOAL.format(callback.name), part)
            groups.append(CallbackGroup(name=name, type=GroupType.EXCLUSIVE))
            server = replace(callback, entity=EntityKind.SERVICE, key=_RESULT.format(key))
            callbacks.append(replace(server, group=name, groupless=False))
        elif callback.entity is EntityKind.ACTION_SERVER:
            server = replace(callback, entity=EntityKind.SERVICE, key=_GOAL.format(key))
            callbacks.append(server)
        else:
            callbacks.append(callback)
    activities = (replace(each, blocking=_both(each.blocking, second)) for each in part.activities)
    used = {callback.group for callback in callbacks}
    return replace(
        part,
        callbacks=tuple(callbacks),
        groups=tuple(group for group in groups if group.name in used),
        activities=tuple(activities),
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
        if is_one and callback.name in _reached(callback.name, ahead):
            return str(callback.key)
    return None


def _reached(name: str, ahead: Mapping[str, set[str]]) -> set[str]:
    found: set[str] = set()
    left = [name]
    while left:
        new = ahead.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


def _clients(callback: Callback, name: str) -> list[Callback]:
    client = replace(callback, entity=EntityKind.CLIENT)
    return [
        replace(client, key=_GOAL.format(callback.key)),
        replace(client, name=name, key=_RESULT.format(callback.key)),
    ]


def _both(blocking: Sequence[Blocking], second: dict[str, str]) -> tuple[Blocking, ...]:
    """Each wait for a whole action as two, one behind the other."""
    found: list[Blocking] = []
    for block in blocking:
        found.append(block)
        on = block.on if isinstance(block.on, str) else ''
        if on in second and block.call.rpartition('.')[2] == _WHOLE:
            name = second[on]
            wakers = tuple(Waker(by=name) if each.by == on else each for each in block.wakers)
            resource = name if block.resource == on else block.resource
            found.append(replace(block, on=name, resource=resource, wakers=wakers))
    return tuple(found)


def _free(name: str, part: Spec) -> str:
    taken = set(part.names())
    while name in taken:
        name += '_'
    return name
