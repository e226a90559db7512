"""What is done to an object that code waits for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.machine.item_values import ends
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.concurrency.waits.outside_waits import come_behind
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import RosWorld
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import Doer
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, TIME, WORKING_LOOP, Blocking, Waker
from ros2cc_extract.spec.model import ActivityKind

_KEPT = 'it is kept in a collection, and the code that takes it out could not be followed'


def wakings_of(world: RosWorld, reference: ResourceRef) -> list[Waking]:
    """
    What is done to an object.

    A callback makes an object of its own each time; what ends the wait for one of them, from one
    place, ends it for all, where nothing is seen that ends it for this one. What notifies of other
    data than a wait for a condition asks for does not end it, nor what is put into a queue but is
    not the item at which a loop ends.
    """
    found = [w for w in _all_of(world, reference) if not _is_other_item(w, reference)]
    names = reference.guard.until if reference.guard is not None else frozenset()
    if not names or _may_be_passed_on(world, reference, names, found):
        return found
    return [w for w in found if w.word is not Word.SET or _may_speak_of(names, w.by)]


def _is_other_item(waking: Waking, reference: ResourceRef) -> bool:
    is_asked = bool(reference.until) and waking.word is Word.PUT
    return is_asked and ends(reference.until, waking.item) is False


def why_no_item(
    raw: Blocking, reference: ResourceRef, mine: Sequence[Waking], world: RosWorld
) -> Unknown | None:
    """
    Why it is not known whether a loop is ended by the item that it asks for.

    A thread whose loop nothing ends that is put there goes on.
    """
    if not reference.until:
        return None
    puts = [w for w in _all_of(world, reference) if w.word is Word.PUT]
    if puts and not mine and raw.call != WORKING_LOOP:
        return Unknown('nothing that is put into it ends the loop', reference.made)
    unsure = (w.place for w in mine if ends(reference.until, w.item) is None)
    place = next(unsure, None)
    return Unknown('whether what is put there ends the loop', place) if place is not None else None


def is_of_other_data(world: RosWorld, reference: ResourceRef) -> bool:
    """Whether a condition is notified, but of nothing that the wait asks for."""
    found = (w for w in _all_of(world, reference) if w.word in reference.ended_by)
    return reference.guard is not None and bool(reference.guard.until) and any(found)


def gives_one_of_several(reference: ResourceRef, mine: Sequence[Waking]) -> bool:
    """Whether a wait for a condition asks for several things, which different code brings."""
    guard = reference.guard
    if guard is None or not guard.is_of_several:
        return False
    brought = {
        frozenset((w.name, w.item) for w in waking.by.effects.writes if w.name in guard.names)
        for waking in mine
        if isinstance(waking.by, Doer) and waking.by.effects is not None
    }
    return len(brought) > 1


def _all_of(world: RosWorld, reference: ResourceRef) -> list[Waking]:
    known = world.wakings.get(reference.number)
    if known is not None:
        return known
    return world.done_alike(reference.number, reference.like)


def _may_be_passed_on(
    world: RosWorld, reference: ResourceRef, names: frozenset[str], wakings: list[Waking]
) -> bool:
    """Whether code that notifies of nothing, and does not wait itself, may write the data."""
    if data_is_written_elsewhere(world, names) or names & world.writes_beside.keys():
        return True
    notifying = {id(waking.by) for waking in wakings if waking.word is Word.SET}
    others = (d for d in (*world.entities, *world.activities) if id(d) not in notifying)
    return any(_writes_some(names, d) and not _waits_for(reference, d) for d in others)


def _may_speak_of(names: frozenset[str], by: object) -> bool:
    return not isinstance(by, Doer) or _writes_some(names, by)


def _writes_some(names: frozenset[str], doer: Doer) -> bool:
    return doer.effects is not None and any(each.name in names for each in doer.effects.writes)


def _waits_for(reference: ResourceRef, doer: Doer) -> bool:
    resources = (each.resource for each in (doer.effects.blocking if doer.effects else ()))
    return any(isinstance(r, ResourceRef) and r.number == reference.number for r in resources)


def comes_last(waking: Waking, world: RosWorld) -> bool:
    """Whether the set-up does it when its last spin is over, and no callback runs any more."""
    is_behind = 0 < waking.spins == world.main_spins
    return waking.by is None and (waking.after_spin or is_behind)


def ended_last(
    given: Sequence[Waking], doer: Doer, world: RosWorld, reference: ResourceRef
) -> Place | None:
    """
    Where the program ends a wait of a thread: its spin is over, and it has not joined that.

    Its end alone ends what nobody else can.
    """
    if not isinstance(doer, ActivityState):
        return None
    if not given and reference.number in world.served:
        return world.served[reference.number]
    in_time = (waking for waking in given if not come_behind([waking.ended], doer.runners))
    last = (waking for waking in in_time if comes_last(waking, world))
    return next((waking.place for waking in last), None)


def by_interruption(
    raw: Blocking, reference: ResourceRef, mine: Sequence[Waking], doer: Doer, world: RosWorld
) -> list[Waker]:
    """What ends a wait of the main program that catches the signal which ends it."""
    is_join = Word.END in reference.ended_by and getattr(doer, 'kind', None) is ActivityKind.MAIN
    is_caught = reference.number in world.interruptible and (is_join or not mine)
    return [Waker(by=OUTSIDE, source=raw.source)] if is_caught else []


def why_none(raw: Blocking, mine: Sequence[Waking], doer: Doer, world: RosWorld) -> Unknown | None:
    """Why it is not known whether a wait without a known waker ends."""
    if mine or not isinstance(raw.resource, ResourceRef):
        return None
    words = raw.resource.ended_by
    if Word.ARRIVE in words and isinstance(doer, ActivityState) and doer.count != 1:
        return Unknown('how many threads come there is not known', raw.source)
    if words == {Word.END}:
        is_join = raw.call.endswith('.join')
        reason = 'no known code starts it' if is_join else 'its end is not known'
        return Unknown(reason, raw.source)
    kept = world.kept_inside.get(raw.resource.number)
    return Unknown(_KEPT, kept) if kept is not None else None


def as_unsure(wakers: Iterable[Waker]) -> tuple[Waker, ...]:
    """The same wakers, marked as perhaps not coming."""
    return tuple(replace(waker, conditional=True) for waker in wakers)


def is_in_turn(reference: ResourceRef, doer: object) -> bool:
    """Whether a thread takes what others give it, one by one."""
    return isinstance(doer, ActivityState) and not reference.is_kept


def ends_by_itself(wakers: Iterable[Waker]) -> bool:
    """Whether time or the outside ends the wait."""
    return any(waker.by in (OUTSIDE, TIME) for waker in wakers)
