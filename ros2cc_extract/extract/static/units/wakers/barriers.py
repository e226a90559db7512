"""
Barriers: what comes to one, and whether all come to every round of it.

A barrier lets its parties through together and begins anew (CPython 3.12, ``threading.py``,
``Barrier``). One that comes once more than the others waits for a party that does not come; if
more come than it lets through, those of different rounds meet.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, GroupState
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import GroupType

Doer = EntityState | ActivityState
Visits = Mapping[Doer, Sequence[Blocking]]

CALL = 'Barrier.wait'


def visits_of(reference: ResourceRef, doers: Sequence[Doer]) -> Visits:
    """The waits at a barrier, of all that come to it."""
    numbers = {reference.number, *reference.like}
    found: dict[Doer, list[Blocking]] = {}
    for doer in doers:
        for block in (doer.effects or EffectLog()).blocking:
            resource = block.resource
            if not isinstance(resource, ResourceRef) or block.call != CALL:
                continue
            if resource.number in numbers:
                found.setdefault(doer, []).append(block)
    return found


def of_its_round(raw: Blocking, doer: Doer, visits: Visits, mine: list[Waking]) -> list[Waking]:
    """The arrivals of others in the round in which ``doer`` waits at ``raw``."""
    sources = [block.source for block in visits.get(doer, ())]
    rounds = {source: number for number, source in enumerate(sources)}
    if len(rounds) != len(sources) or raw.source not in rounds:
        return mine
    others = {id(other): [block.source for block in blocks] for other, blocks in visits.items()}
    number = rounds[raw.source]
    return [
        waking
        for waking in mine
        if waking.place == _at(others.get(id(waking.by), ()), number, waking.place)
    ]


def _at(sources: Sequence[object], number: int, otherwise: object) -> object:
    return sources[number] if number < len(sources) else otherwise


def is_in_vain(reference: ResourceRef, visits: Visits, mine: Sequence[Waking]) -> bool:
    """Whether fewer come than must."""
    parties = reference.parties
    is_known = not _others_come(visits, mine) and _reason(reference, visits, mine) is None
    return parties is not None and parties > len(visits) and is_known


def _others_come(visits: Visits, mine: Sequence[Waking]) -> bool:
    return any(waking.by not in visits for waking in mine)


def why_rounds_differ(
    raw: Blocking, reference: ResourceRef, visits: Visits, mine: Sequence[Waking]
) -> Unknown | None:
    """Why it is not certain that all come at each wait."""
    reason = _reason(reference, visits, mine)
    return None if reason is None else Unknown(reason, raw.source)


def _reason(reference: ResourceRef, visits: Visits, mine: Sequence[Waking]) -> str | None:
    if _others_come(visits, mine):
        return None  # who they are is found elsewhere
    if not reference.is_own and any(_may_meet_itself(doer) for doer in visits):
        return 'several runs of one that comes may meet there'
    parties = reference.parties
    if parties is None:
        return 'how many must come is not known'
    if parties > len(visits):
        return None  # nothing ever ends it
    if parties < len(visits):
        return f'{parties} must come, and more do'
    if len({tuple(block.times for block in blocks) for blocks in visits.values()}) > 1:
        return 'not all come there equally often'
    if any(waking.in_loop and not _goes_round(waking.by) for waking in mine):
        return 'how often a loop comes there is not known'
    if len({_comes_again(doer) for doer in visits}) > 1:
        return 'not all come there again'
    return None


def _may_meet_itself(doer: Doer) -> bool:
    if isinstance(doer, ActivityState):
        return doer.count != 1 and not _is_started_by_callbacks(doer)
    group = doer.group.state
    is_known = isinstance(group, GroupState) and group.unresolved is None
    return not is_known or group.type is not GroupType.EXCLUSIVE


def _goes_round(doer: object) -> bool:
    return isinstance(doer, ActivityState) and doer.loops


def _comes_again(doer: Doer) -> bool:
    if isinstance(doer, EntityState):
        return not doer.one_shot or doer.restarted
    return doer.loops or _is_started_by_callbacks(doer)


def _is_started_by_callbacks(doer: ActivityState) -> bool:
    starters = [start.by for start in doer.starts]
    return bool(starters) and all(
        isinstance(by, (EntityState, ActivityState)) and _comes_again(by) for by in starters
    )
