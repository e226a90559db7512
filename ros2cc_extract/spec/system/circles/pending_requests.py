"""
How many requests at a time the clients of one program may have on their way to a service.

Each client may have one, whatever the others do; those that only wait for answers have no
more than their callers can wait at once. What no unit alone shows stands in the unit of the
service.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Activity, Callback, EntityKind, GroupType, Spec, When

SEVERAL = 2


def with_askers(units: Sequence[Spec]) -> list[Spec]:
    """The units of a program, services with the number of clients that may ask at once."""

    def asked(callback: Callback, unit: Spec) -> Callback:
        if callback.entity is not EntityKind.SERVICE or not isinstance(callback.key, str):
            return callback
        beside = (each for each in units if _run_together(each, unit))
        number = sum(askers_in(callback.key, each) for each in beside)
        return replace(callback, askers=number) if number >= SEVERAL else callback

    return [
        replace(unit, callbacks=tuple(asked(each, unit) for each in unit.callbacks))
        for unit in units
    ]


def _run_together(one: Spec, other: Spec) -> bool:
    """Whether a unit is spun on every branch, or on that of the other."""
    mark, branch = one.executor.alternative, one.executor.branch
    is_own = one is other or mark is None
    is_own = is_own or (mark, branch) == (other.executor.alternative, other.executor.branch)
    return is_own and one.executor.spun is not None and one.executor.unresolved is None


def askers_in(service: str, unit: Spec) -> int:
    """How many requests to a service the clients of a unit may have on their way at once."""
    clients = [each for each in unit.callbacks if _asks(each, service)]
    waiting = {name: set(_callers(name, unit)) for name in (each.name for each in clients)}
    free = sum(_count(each) for each in clients if not waiting[each.name])
    callers = {caller for each in clients for caller in waiting[each.name]}
    held = sum(_count(each) for each in clients if waiting[each.name])
    return free + min(held, len(callers), *_threads(unit, clients))


def _asks(callback: Callback, service: str) -> bool:
    is_sure = callback.when is When.START and not callback.conditional
    is_sure = is_sure and callback.alternative is None and not callback.destroyed
    return callback.entity is EntityKind.CLIENT and callback.key == service and is_sure


def _count(client: Callback) -> int:
    return client.count if isinstance(client.count, int) else 1


def _callers(client: str, unit: Spec) -> Iterator[str]:
    """How many wait for its answers: of one mutually exclusive group only one at a time."""
    for callback in unit.callbacks:
        if _waits_for(client, callback.blocking):
            group = unit.group_of(callback)
            yield group.name if group.type is GroupType.EXCLUSIVE else callback.name
    for activity in unit.activities:
        if _waits_for(client, activity.blocking):
            yield activity.name


def _waits_for(client: str, blocking: Iterable[Blocking]) -> bool:
    return any(block.on == client for block in blocking)


def _threads(unit: Spec, clients: Iterable[Callback]) -> Iterator[int]:
    """Callbacks that hold their threads while they wait are no more than there are threads."""
    names = {client.name for client in clients}
    doers: tuple[Callback | Activity, ...] = (*unit.callbacks, *unit.activities)
    blocks = [block for doer in doers for block in doer.blocking if block.on in names]
    is_held = not unit.activities and all(not block.suspends for block in blocks)
    if is_held and isinstance(unit.executor.kind, str):
        yield len(unit.executor.threads)
