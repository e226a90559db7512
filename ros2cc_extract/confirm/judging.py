"""
What was seen, and whether that is what the finding says.

A hang is confirmed only where two explanations of ``why``, some seconds apart, have the same call
stand at the finding's line, and nothing left that could end its wait. An exception is confirmed
where it was raised at that line.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path

from ros2cc_extract.confirm.observations import Observations, Sample
from ros2cc_extract.confirm.schedules import Point, Schedule
from ros2cc_extract.confirm.statements import loop_future, tree_of
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind, locks_held
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Frame, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import (
    Explanation,
    Standing,
    explain,
)

APART_S = 2.0
"""Between the two explanations that must agree."""
_EXCEPTIONS = {
    'CC107': ('RuntimeError', 'ValueError'),
    'CC108': ('RuntimeError',),
    'CC113': ('TypeError',),
    'CC114': ('RuntimeError',),
}
_WORDS = {'CC107': ('generator already executing', 'already spinning'), 'CC113': ('coroutine',)}
_NESTED_SPINS = ('CC106', 'CC107')


class Outcome(Enum):
    """What came of a finding on the running node."""

    CONFIRMED = 'confirmed'
    NOT_REACHED = 'not reached'
    CONTRADICTED = 'contradicted'


@dataclass(frozen=True)
class Judgement:
    """
    :param reason: what was seen, or what is missing, in a clause.
    :param evidence: the explanation of ``why``, or the exception.
    """

    outcome: Outcome
    reason: str
    evidence: str = ''


def confirmed(schedule: Schedule, seen: Observations) -> Judgement | None:
    """Judge while the node runs: `None` until something is shown."""
    ways: tuple[Callable[[Schedule, Observations], Judgement | None], ...] = (
        _hang,
        _exception,
        _nested,
        _node_lost,
        _shut_out,
        _kept_lock,
        _crossed_locks,
    )
    return next((found for way in ways if (found := way(schedule, seen)) is not None), None)


def _hang(schedule: Schedule, seen: Observations) -> Judgement | None:
    if not schedule.points:
        return None
    for later in seen.samples[-1:]:
        for earlier in seen.samples:
            if later.at - earlier.at < APART_S:
                break
            found = _stands_in_both(schedule, earlier, later)
            if found is not None:
                seconds = later.at - earlier.at
                reason = f'waits at line {schedule.points[0].first} for {seconds:.0f} s and more'
                return Judgement(Outcome.CONFIRMED, reason, as_text((found,)))
    return None


def _stands_in_both(schedule: Schedule, earlier: Sample, later: Sample) -> Explanation | None:
    before, after = _explained(schedule, earlier), _explained(schedule, later)
    if after.look.unread or before.look.unread:
        return None
    stood = [each for each in before.standings if _never_ends(each, schedule)]
    for now in after.standings:
        if _never_ends(now, schedule):
            for each in stood:
                if each.activity.stands_as(replace(now.activity, ticks=each.activity.ticks)):
                    return after
    return None


def _never_ends(standing: Standing, schedule: Schedule) -> bool:
    if standing.moved or not _frame_at(standing.activity, schedule.points):
        return False
    # Nobody holds a lock that was kept by a callback which is over.
    return not standing.can_end


def _frame_at(activity: Activity, points: Sequence[Point]) -> Frame | None:
    """The innermost frame that stands at one of the points."""
    for frame in reversed(activity.frames):
        if any(each.first <= frame.line <= each.last and _is_of(frame, each) for each in points):
            return frame
    return None


def _is_of(frame: Frame, point: Point) -> bool:
    return os.path.realpath(frame.file) == point.file  # noqa: PTH


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
    frame = _frame_at(activity, schedule.points)
    if frame is None or activity.ident is None:
        return None
    name = loop_future(tree_of(Path(frame.file)), frame.line)
    future = frame.objects.get(name or '')
    if future is None:
        return None
    outer = activity.frames[: activity.frames.index(frame)]
    still = replace(frame, at=0)
    return replace(activity, frames=(*outer, still), future=future, ticks=None)


def _exception(schedule: Schedule, seen: Observations) -> Judgement | None:
    names = _EXCEPTIONS.get(schedule.code, ())
    for row in seen.raised:
        if row['type'] in names and row['point'] == 0:
            text = f'{row["type"]}: {row["text"]}'
            return Judgement(
                Outcome.CONFIRMED, f'raises {row["type"]} at line {schedule.line}', text
            )
    # Where no line of the program raises: it has only handed something to rclpy.
    words = _WORDS.get(schedule.code, ())
    if words:
        for row in seen.failed:
            if row['type'] in names and any(each in row['text'] for each in words):
                text = f'{row["type"]}: {row["text"]}'
                return Judgement(Outcome.CONFIRMED, f'raises {row["type"]}', text)
    return None


def _nested(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A callback has begun inside the one that spins."""
    if schedule.code not in _NESTED_SPINS or schedule.leaves:
        return None
    for row in seen.nested:
        if row['point'] == 0:
            reason = f'{row["name"]} began inside the nested spin at line {schedule.line}'
            return Judgement(Outcome.CONFIRMED, reason)
    return None


def _node_lost(schedule: Schedule, seen: Observations) -> Judgement | None:
    """The node of the callback is in no executor after its nested spin, and nothing of it begins."""
    if not schedule.leaves or not seen.passed.get(0):
        return None
    after = [each for each in seen.samples if each.at > seen.passed_at]
    if not after or after[-1].at - after[0].at < APART_S:
        return None
    lost = _out_of_executors(after[0]) & _out_of_executors(after[-1])
    begun = {entity for at, entity in seen.begins if at > after[0].at}
    if lost and not lost & begun:
        last = after[-1].looks[1]
        nodes = sorted({last.entities[each].node for each in lost})
        seconds = after[-1].at - after[0].at
        reason = f'{", ".join(nodes)} is in no executor for {seconds:.0f} s and more'
        return Judgement(Outcome.CONFIRMED, reason, as_text((after[-1].explanation,)))
    return None


def _shut_out(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A callback spins on and on, and no other member of its group begins meanwhile."""
    pair = _pair(seen)
    if schedule.code != 'CC106' or pair is None or not seen.reached.get(0):
        return None
    earlier, later = pair
    stood = {frame.number for _, frame in _at_first_point(schedule, earlier)}
    for activity, frame in _at_first_point(schedule, later):
        shut = _others_in_group(later.looks[1], activity)
        begun = {entity for at, entity in seen.begins if at > earlier.at}
        if frame.number in stood and shut and not shut & begun:
            reason = (
                f'spins at line {schedule.line} for {later.at - earlier.at:.0f} s and more, and no '
                'other member of its group has begun'
            )
            return Judgement(Outcome.CONFIRMED, reason, as_text((later.explanation,)))
    return None


def _pair(seen: Observations) -> tuple[Sample, Sample] | None:
    """The last sample, and the last one before that is far enough from it."""
    last = seen.samples[-1] if seen.samples else None
    before = [each for each in seen.samples if last and last.at - each.at >= APART_S]
    return (before[-1], last) if last is not None and before else None


def _at_first_point(schedule: Schedule, sample: Sample) -> Iterator[tuple[Activity, Frame]]:
    for each in sample.looks[1].activities:
        frame = _frame_at(each, schedule.points[:1])
        if frame is not None:
            yield each, frame


def _others_in_group(look: Look, activity: Activity) -> set[int]:
    """What somebody has written into the groups that a callback keeps closed."""
    own = {look.entities[each].group for each in activity.entities if each in look.entities}
    return {
        number
        for number, each in look.entities.items()
        if each.group in own and each.exclusive and not each.builtin
    } - set(activity.entities)


def _kept_lock(schedule: Schedule, seen: Observations) -> Judgement | None:
    """The callback is over, and another one waits for a lock that nobody is left to give back."""
    pair = _pair(seen)
    if schedule.code != 'CC112' or not seen.passed.get(0) or pair is None:
        return None
    waits = [_waits_for_kept(each) for each in pair]
    for activity in waits[1]:
        if any(activity.stands_as(each) for each in waits[0]):
            reason = f'line {activity.place.line} waits for the lock that was kept'
            return Judgement(Outcome.CONFIRMED, reason, as_text((pair[1].explanation,)))
    return None


def _crossed_locks(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    A thread stands at each of the two places, and nothing else runs.

    Of a ``with`` for two locks the interpreter does not tell which one is waited for.
    """
    pair = _pair(seen)
    if schedule.code != 'CC111' or len(schedule.points) < 2 or pair is None:
        return None
    stood, stand = (_at_locks(schedule, each) for each in pair)
    if len(stand) == len(schedule.points) and all(
        point in stood and activity.stands_as(stood[point]) for point, activity in stand.items()
    ):
        lines = ' and '.join(str(each.first) for each in schedule.points)
        reason = f'wait for the locks at lines {lines} for {APART_S:.0f} s and more'
        return Judgement(Outcome.CONFIRMED, reason, as_text((pair[1].explanation,)))
    return None


def _at_locks(schedule: Schedule, sample: Sample) -> dict[Point, Activity]:
    inside = [each for each in sample.explanation.standings if each.in_callback]
    if any(each.wait.kind is not Kind.LOCK or each.moved or each.wait.timed for each in inside):
        return {}
    return {
        point: each.activity
        for point in schedule.points
        for each in inside
        if _frame_at(each.activity, (point,))
    }


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


def _out_of_executors(sample: Sample) -> set[int]:
    look = sample.looks[1]
    served = {entity for executor in look.executors for entity in executor.entities}
    return {number for number, each in look.entities.items() if not each.builtin} - served


def not_confirmed(schedule: Schedule, seen: Observations, said: str, *, ended: bool) -> Judgement:
    """Say why nothing was shown, after the time is over or the program has ended."""
    missing = _missing_module(said)
    if missing:
        reason = f'needs the module {missing}, which is not there; see --stub-missing'
        return Judgement(Outcome.NOT_REACHED, reason)
    if not seen.process:
        return Judgement(Outcome.NOT_REACHED, 'the program did not start', _last(said))
    points = [number for number, _ in enumerate(schedule.points) if not seen.reached.get(number)]
    if points:
        lines = ', '.join(str(schedule.points[each].first) for each in points)
        why = 'the program ended before' if ended else 'needs other data than was sent'
        return Judgement(Outcome.NOT_REACHED, f'line {lines} was not reached: {why}', _last(said))
    if seen.given_up:
        lines = ', '.join(str(schedule.points[each].first) for each in seen.given_up)
        return Judgement(
            Outcome.NOT_REACHED, f'line {lines} was not reached while the others waited'
        )
    if schedule.forever and seen.passed.get(0):
        reason = f'the wait at line {schedule.line} ended; the model says that it never does'
        return Judgement(Outcome.CONTRADICTED, reason, _last_look(seen))
    return Judgement(Outcome.NOT_REACHED, 'was reached, but nothing was shown', _last_look(seen))


def _last_look(seen: Observations) -> str:
    return as_text((seen.samples[-1].explanation,)) if seen.samples else ''


def _missing_module(said: str) -> str | None:
    for line in reversed(said.splitlines()):
        if line.startswith('ModuleNotFoundError: No module named '):
            return line.rpartition(' ')[2].strip("'")
    return None


def _last(said: str) -> str:
    return '\n'.join(_without_empty(said))


def _without_empty(said: str) -> Iterator[str]:
    yield from [line for line in said.splitlines() if line.strip()][-3:]
