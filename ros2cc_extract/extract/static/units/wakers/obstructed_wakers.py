"""
Wakers that others may keep from ending a wait, in ways that no model has.

A task is there only when its maker has run; a loop of asyncio runs one coroutine at a time, which
holds it while it blocks; and who puts something in and takes it out again in the same run may be
the one who gets it. Such a waker is one that perhaps never comes.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.units.wakers.mutual_exclusion import may_not_overlap
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState
# What one gets the next one does not get.
_FOR_ONE = frozenset({Word.PUT, Word.GET, Word.RELEASE})


def is_kept_out(waking: Waking, reference: ResourceRef, doer: Doer, doers: Sequence[Doer]) -> bool:
    """Whether ``waking`` may not come while ``doer`` waits, or be for somebody else."""
    by = waking.by
    if by is doer:
        return False
    return (
        is_off_its_loop(by, doers)
        or _is_made_by_one_kept_out(by, doer)
        or _takes_back(waking, reference)
    )


def is_off_its_loop(by: object, doers: Sequence[Doer]) -> bool:
    """Whether it is to run on a loop of asyncio that somebody else may block."""
    return isinstance(by, ActivityState) and any(_holds_the_loop_of(by, each) for each in doers)


def _is_made_by_one_kept_out(by: object, doer: Doer) -> bool:
    if not isinstance(by, EntityState) or by.kind is not EntityKind.TASK:
        return False
    return by.maker is not doer and may_not_overlap(by.maker, doer)


def _holds_the_loop_of(by: ActivityState, other: Doer) -> bool:
    """Whether ``other`` may block the loop on which ``by`` is to run; an await gives it back."""
    if not isinstance(other, ActivityState) or other is by or not (by.on_loop and other.on_loop):
        return False
    return by.turns == other.turns and any(
        block.seconds is None
        and not block.call.startswith(('asyncio', 'await'))
        and block.source not in other.effects.resting
        for block in other.effects.blocking
    )


def _takes_back(waking: Waking, reference: ResourceRef) -> bool:
    by = waking.by
    if not _FOR_ONE & reference.ended_by or not isinstance(by, EntityState | ActivityState):
        return False
    blocks = (by.effects or EffectLog()).blocking
    ways = [way_of(block) for block in blocks]
    begin = ways.index(waking.behind) + 1 if waking.behind in ways else 0
    return any(
        isinstance(block.resource, ResourceRef)
        and block.resource.number == reference.number
        and block.resource.ended_by == reference.ended_by
        for block in blocks[begin:]
    )
