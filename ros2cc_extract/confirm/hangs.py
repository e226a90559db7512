"""
Hangs: what stands at the finding's line and never ends.

Two explanations of ``why``, some seconds apart, must have the same call stand there, and nothing
left that could end its wait.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.confirm.observations import Observations, Sample
from ros2cc_extract.confirm.outcomes import APART_S, Judgement, Outcome, frame_at, pair
from ros2cc_extract.confirm.schedules import Point, Schedule
from ros2cc_extract.confirm.statements import loop_future, tree_of
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, locks_held
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    BY_ANY_CODE,
    Explanation,
    Standing,
    explain,
)

#: What they say of a nested spin is something else, and the exceptions end what they are about.
_CLAIM_NO_HANG = frozenset({'CC106', 'CC107', 'CC108', 'CC113', 'CC114'})


def hang(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A call stands at the finding's line, and nothing is left that could end its wait."""
    if not schedule.points or schedule.code in _CLAIM_NO_HANG:
        return None
    for later in seen.samples[-1:]:
        for earlier in seen.samples:
            if later.at - earlier.at < APART_S:
                break
            found = _stands_in_both(schedule, earlier, later, seen)
            if found is not None:
                seconds = later.at - earlier.at
                reason = f'waits at line {schedule.points[0].first} for {seconds:.0f} s and more'
                return Judgement(Outcome.CONFIRMED, reason, as_text((found,)))
    return None


def _stands_in_both(
    schedule: Schedule, earlier: Sample, later: Sample, seen: Observations
) -> Explanation | None:
    before, after = _explained(schedule, earlier), _explained(schedule, later)

    def is_meant(each: Standing) -> bool:
        return _never_ends(each, schedule) and not ended_by_stood_in(each, seen)

    return after if stand_in_both(before, after, is_meant) else None


def ended_by_stood_in(standing: Standing, seen: Observations) -> bool:
    """Whether the module that is stood in for might end it: it would call what it was given."""
    return bool(seen.handed) and standing.wait.kind in BY_ANY_CODE


def stand_in_both(
    before: Explanation, after: Explanation, is_meant: Callable[[Standing], bool]
) -> list[Standing]:
    """
    What is meant of a later explanation, and stood just so in the earlier one.

    Nothing where a look could not read everything.
    """
    if after.look.unread or before.look.unread:
        return []
    stood = [each.activity for each in before.standings if is_meant(each)]
    return [
        now
        for now in after.standings
        if is_meant(now)
        and any(each.stands_as(replace(now.activity, ticks=each.ticks)) for each in stood)
    ]


def _never_ends(standing: Standing, schedule: Schedule) -> bool:
    is_there = frame_at(standing.activity, schedule.points[:1]) is not None
    return is_there and not standing.moved and not standing.can_end


def _explained(schedule: Schedule, sample: Sample) -> Explanation:
    """
    Explain what was seen, a loop that asks for a future as a wait for it.

    Such a loop moves all the time, and yet goes nowhere before the future is done.
    """
    looks = sample.looks
    loops = [_loop(each, schedule) for look in looks for each in look.activities]
    if not any(loops):
        return sample.explanation
    before, after = (_with_loops(look, schedule) for look in looks)
    return explain(sample.explanation.process, (before, after))


def _with_loops(look: Look, schedule: Schedule) -> Look:
    return replace(
        look, activities=tuple(_loop(each, schedule) or each for each in look.activities)
    )


def _loop(activity: Activity, schedule: Schedule) -> Activity | None:
    """The activity as if it awaited the future that its loop asks for; `None` if it does not."""
    frame = frame_at(activity, schedule.points[:1])
    if frame is None or activity.ident is None:
        return None
    name = loop_future(tree_of(Path(frame.file)), frame.line)
    future = frame.objects.get(name or '')
    if future is None:
        return None
    outer = activity.frames[: activity.frames.index(frame)]
    still = replace(frame, at=0)
    return replace(activity, frames=(*outer, still), future=future, ticks=None)


def kept_lock(schedule: Schedule, seen: Observations) -> Judgement | None:
    """The callback is over, and another one waits for a lock that nothing is left to give back."""
    both = pair(seen)
    if schedule.code != 'CC112' or not seen.passed.get(0) or both is None:
        return None
    waits = [_waits_for_kept(each) for each in both]
    for activity in waits[1]:
        if any(activity.stands_as(each) for each in waits[0]):
            reason = f'line {activity.place.line} waits for the lock that was kept'
            return Judgement(Outcome.CONFIRMED, reason, as_text((both[1].explanation,)))
    return None


def _waits_for_kept(sample: Sample) -> list[Activity]:
    """Waits for one lock, where no callback does anything else."""
    look = sample.looks[1]
    inside = [each for each in sample.explanation.standings if each.in_callback]
    locks = {each.wait.resource for each in inside}
    if len(locks) != 1 or any(each.wait.kind is not Kind.LOCK or each.moved for each in inside):
        return []
    held = {lock for each in inside for lock, _ in locks_held(each.activity)}
    row = look.objects.get(locks.pop() or 0, {})
    return [each.activity for each in inside] if row.get('locked') and not held else []


def crossed_locks(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    A thread stands at each of the two places, and nothing else runs.

    For a ``with`` of two locks the interpreter does not say which one is waited for.
    """
    both = pair(seen)
    if schedule.code != 'CC111' or len(schedule.points) < 2 or both is None:
        return None
    stood, stand = (_at_locks(schedule, each) for each in both)
    if len(stand) == len(schedule.points) and all(
        point in stood and activity.stands_as(stood[point]) for point, activity in stand.items()
    ):
        lines = ' and '.join(str(each.first) for each in schedule.points)
        reason = f'wait for the locks at lines {lines} for {APART_S:.0f} s and more'
        return Judgement(Outcome.CONFIRMED, reason, as_text((both[1].explanation,)))
    return None


def _at_locks(schedule: Schedule, sample: Sample) -> dict[Point, Activity]:
    inside = [each for each in sample.explanation.standings if each.in_callback]
    if any(each.wait.kind is not Kind.LOCK or each.moved or each.wait.timed for each in inside):
        return {}
    return {
        point: each.activity
        for point in schedule.points
        for each in inside
        if frame_at(each.activity, (point,))
    }


def timed_out(schedule: Schedule, seen: Observations) -> Judgement | None:
    """Every pass has taken the whole time-out, though the server was there."""
    seconds, last = schedule.times_out_s, seen.samples[-1:]
    if seconds is None or not seen.times or not last or min(seen.times) < seconds:
        return None
    entities = last[0].looks[1].entities.values()
    clients = [e for e in entities if e.kind == 'clients' or e.cls == 'ActionClient']
    if not clients or not all(each.there for each in clients):
        return None
    times = 'time' if len(seen.times) == 1 else 'times'
    reason = (
        f'took the whole time-out of {seconds:g} s, {len(seen.times)} {times} of {len(seen.times)}'
    )
    return Judgement(Outcome.CONFIRMED, reason)
