"""
Wakers that others may keep from ending a wait, in ways that no model has.

A task or a done-callback is there only when its maker has run, and an execute callback when a goal
callback has accepted; a loop of asyncio runs one coroutine at a time, which
holds it while it blocks; and code that puts something in and takes it out in the same run may be
the one who gets it. Such a waker is one that perhaps never comes.
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.extract.static.units.wakers.mutual_exclusion import keeps_out, may_not_overlap
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState
# What one gets the next one does not get.
_FOR_ONE = frozenset({Word.PUT, Word.GET, Word.RELEASE})


def is_kept_out(
    waking: Waking, reference: ResourceRef, doer: Doer, doers: Sequence[Doer], wait: Blocking
) -> bool:
    """Whether ``waking`` may not come while ``doer`` is in ``wait``, or be for another wait."""
    by = waking.by
    if by is doer:
        return False
    return (
        is_off_its_loop(by, doers)
        or _is_begun_by_one_kept_out(by, doer, doers, wait)
        or _takes_back(waking, reference)
    )


def is_off_its_loop(by: object, doers: Sequence[Doer]) -> bool:
    """Whether it is to run on a loop of asyncio that other code may block."""
    return isinstance(by, ActivityState) and any(_holds_the_loop_of(by, each) for each in doers)


def _is_begun_by_one_kept_out(
    by: object, doer: Doer, doers: Sequence[Doer], wait: Blocking
) -> bool:
    if not isinstance(by, EntityState):
        return False
    if by.kind is EntityKind.ACTION_EXECUTE:
        servers = (each for each in doers if _accepts_for(each, by))
        return any(server is doer or may_not_overlap(server, doer) for server in servers)
    is_made = by.kind in (EntityKind.TASK, EntityKind.DONE_CALLBACK) and by.maker is not doer
    if not is_made or _is_of_one_request(by, doer):
        return False
    if wait.suspends:
        return keeps_out(doer, by.maker, wait)
    return may_not_overlap(by.maker, doer)


def _is_of_one_request(by: EntityState, doer: Doer) -> bool:
    """Whether ``doer``, as a feedback callback, comes of the request whose answer ``by`` takes."""
    return isinstance(doer, EntityState) and by.key is not None and doer.key == by.key


def _accepts_for(other: Doer, execute: EntityState) -> bool:
    """Whether ``other`` runs the goal callback of the action server of ``execute``."""
    if not isinstance(other, EntityState) or other.kind is not EntityKind.ACTION_SERVER:
        return False
    return (other.node, other.place) == (execute.node, execute.place)


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
