"""
Threads that empty a queue round by round, and wait for nothing else meanwhile.

Code that waits for room goes on when such a thread has taken the next item, however large the
queue is and however often items are put: no number of runs uses it up. Code that joins it goes on
when such a thread has done the last one, and at once if it is empty.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wait_table import NO_ROW
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    ResourceRef,
    Waking,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.libraries.rclpy.machine.waits import WAITS
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.units.wakers.initial_permits import Doer
from ros2cc_extract.extract.static.units.wakers.operations import wakings_of
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import RE_ENTRANT, TIME, WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import ActivityKind

_ENDED_BY = {'Queue.put': Word.GET, 'Queue.join': Word.DONE}


def may_find_it_done(raw: Blocking, wakings: Iterable[Waking], doer: Doer) -> bool:
    """Whether code that joins a queue has put nothing in itself: it may be empty, and all done."""
    puts = (waking.by for waking in wakings if waking.word is Word.PUT)
    return raw.call == 'Queue.join' and not any(by is doer for by in puts)


def taken_by_itself(raw: Blocking, world: RosWorld, doers: Sequence[Doer]) -> Place | None:
    """
    Where a thread takes out of the queue, or is done, for sure.

    Nothing but its own work keeps it from that.
    """
    queue, word = raw.resource, _ENDED_BY.get(raw.call)
    if word is None or not isinstance(queue, ResourceRef):
        return None
    wakings = world.wakings.get(queue.number, ())
    if any(w.word is Word.PUT and w.is_sign and isinstance(w.by, EntityState) for w in wakings):
        return None  # that may be the last one
    for waking in wakings:
        by = waking.by
        if waking.word is not word or not isinstance(by, ActivityState):
            continue
        is_sure = waking.in_loop and not waking.conditional and _is_begun(by)
        if is_sure and _goes_on(by, queue, world, doers):
            return waking.place
    return None


def _is_begun(thread: ActivityState) -> bool:
    """Whether the set-up starts it for certain."""
    is_one = thread.kind is ActivityKind.THREAD and thread.count == 1 and not thread.path
    starts = thread.starts
    return is_one and bool(starts) and all(s.by is None and not s.conditional for s in starts)


def _goes_on(
    thread: ActivityState, queue: ResourceRef, world: RosWorld, doers: Sequence[Doer]
) -> bool:
    others = [block for block in thread.effects.blocking if not _takes(block, queue)]
    for block in others:
        if block.call == WORKING_LOOP:
            if _is_ended_by_callbacks(block, world, doers):
                return False
        elif not _ends_by_itself(block):
            return False
    return not _may_be_locked_out(thread, doers)


def _takes(block: Blocking, queue: ResourceRef) -> bool:
    on = block.resource
    is_same = isinstance(on, ResourceRef) and on.number == queue.number
    return is_same and block.call == 'Queue.get'


def _ends_by_itself(block: Blocking) -> bool:
    row = WAITS.get(block.call, NO_ROW)
    return isinstance(block.seconds, float | int) or row.always == (TIME,)


def _is_ended_by_callbacks(loop: Blocking, world: RosWorld, doers: Sequence[Doer]) -> bool:
    """What ends the work of the thread while callbacks run leaves them without it."""
    on = loop.resource if loop.resource is not None else loop.on
    if isinstance(on, DataRef):
        callbacks = [doer for doer in doers if isinstance(doer, EntityState)]
        writes = (write for each in callbacks if each.effects for write in each.effects.writes)
        return any(write.name in on.names for write in writes)
    if isinstance(on, ResourceRef):
        wakings = (w for w in wakings_of(world, on) if w.word in on.ended_by)
        return any(isinstance(waking.by, EntityState) for waking in wakings)
    return True


def _may_be_locked_out(thread: ActivityState, doers: Sequence[Doer]) -> bool:
    """Whether a doer holds, while it waits for others, a lock that the thread takes."""
    mine = {act.name for act in thread.effects.locks}
    return any(
        not mine.isdisjoint(lock.removesuffix(RE_ENTRANT) for lock in block.held)
        for doer in doers
        if doer is not thread
        for block in (doer.effects or EffectLog()).blocking
        if not _ends_by_itself(block)
    )
