"""What else shows a finding: exceptions, callbacks inside nested spins, nodes that are lost."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.confirm.observations import Observations, Sample
from ros2cc_extract.confirm.outcomes import APART_S, Judgement, Outcome, frame_at, pair
from ros2cc_extract.confirm.schedules import Schedule
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Frame, Look

_EXCEPTIONS = {
    'CC107': ('RuntimeError', 'ValueError'),
    'CC108': ('RuntimeError',),
    'CC113': ('TypeError',),
    'CC114': ('RuntimeError',),
}
# No valid response, such as a coroutine: the error has no message (``service.py``).
_RAISED_BY = {'CC113': 'send_response'}
_WORDS = {'CC107': ('generator already executing', 'already spinning'), 'CC113': ('coroutine',)}


def exception(schedule: Schedule, seen: Observations) -> Judgement | None:
    names = _EXCEPTIONS.get(schedule.code, ())
    for row in seen.raised:
        if row['type'] in names and row['point'] == 0:
            text = f'{row["type"]}: {row["text"]}'
            return Judgement(
                Outcome.CONFIRMED, f'raises {row["type"]} at line {schedule.line}', text
            )
    # Where no line of the program raises: it has only handed something to rclpy.
    words, function = _WORDS.get(schedule.code, ()), _RAISED_BY.get(schedule.code)
    if words:
        for row in seen.failed:
            is_raised = any(each in row['text'] for each in words)
            is_raised = is_raised or (bool(row['frames']) and row['frames'][-1][2] == function)
            if row['type'] in names and is_raised:
                text = f'{row["type"]}: {row["text"]}'
                return Judgement(Outcome.CONFIRMED, f'raises {row["type"]}', text)
    return None


def nested(schedule: Schedule, seen: Observations) -> Judgement | None:
    """The nested spin has taken another callback, and runs it or has it run."""
    if not schedule.runs_inside:
        return None
    for row in seen.nested:
        if row['point'] == 0:
            reason = f'{row["name"]} is run by the nested spin at line {schedule.line}'
            return Judgement(Outcome.CONFIRMED, reason)
    return None


def node_lost(schedule: Schedule, seen: Observations) -> Judgement | None:
    """After its nested spin the node is in no executor, and nothing of it begins."""
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


def _out_of_executors(sample: Sample) -> set[int]:
    look = sample.looks[1]
    served = {entity for executor in look.executors for entity in executor.entities}
    return {number for number, each in look.entities.items() if not each.builtin} - served


def asleep_beside(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    A nested spin sleeps on, nothing of the process begins, and yet a timer is due.

    While the executor that it took the node from ran something of a group, it left that group out
    of its wait. What ran wakes only its own executor at its end (rclpy 7.1.6 and 9.1.2,
    ``executors.py``, `_make_handler`), so this one waits without the client it spins for.
    """
    both = pair(seen)
    if schedule.code != 'CC106' or both is None:
        return None
    earlier, later = both
    stood = {frame.number for _, frame in _at_first_point(schedule, earlier)}
    stands = any(frame.number in stood for _, frame in _at_first_point(schedule, later))
    due = _due(earlier.looks[0]) & _due(later.looks[1])
    if not stands or not due or any(at > earlier.at for at, _ in seen.begins):
        return None
    names = sorted({str(later.looks[1].entities[each].function) for each in due})
    seconds = later.at - earlier.at
    reason = (
        f'spins at line {schedule.line} for {seconds:.0f} s and more, and nothing begins, '
        f'although {", ".join(names)} is due'
    )
    return Judgement(Outcome.CONFIRMED, reason, as_text((later.explanation,)))


def _due(look: Look) -> set[int]:
    """Timers of the program that are not held back, and that run on the clock of the machine."""
    return {
        number
        for number, each in look.entities.items()
        if each.kind == 'timers' and each.ready and not each.builtin and not each.cancelled
        if each.active is None and not each.simulated_clock
    }


def shut_out(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A callback spins on and on, and no other member of its group begins meanwhile."""
    both = pair(seen)
    if schedule.code != 'CC106' or both is None or not seen.reached.get(0):
        return None
    earlier, later = both
    stood = {frame.number for _, frame in _at_first_point(schedule, earlier)}
    for activity, frame in _at_first_point(schedule, later):
        shut = _others_in_group(later.looks[1], activity)
        begun = {entity for at, entity in seen.begins if at > earlier.at}
        if frame.number in stood and shut and not shut & begun:
            reason = (
                f'spins at line {schedule.line} for {later.at - earlier.at:.0f} s and more, and '
                'no other member of its group has begun'
            )
            return Judgement(Outcome.CONFIRMED, reason, as_text((later.explanation,)))
    return None


def _at_first_point(schedule: Schedule, sample: Sample) -> Iterator[tuple[Activity, Frame]]:
    for each in sample.looks[1].activities:
        frame = frame_at(each, schedule.points[:1])
        if frame is not None:
            yield each, frame


def _others_in_group(look: Look, activity: Activity) -> set[int]:
    """User entities in the groups that a callback keeps closed."""
    own = {look.entities[each].group for each in activity.entities if each in look.entities}
    return {
        number
        for number, each in look.entities.items()
        if each.group in own and each.exclusive and not each.builtin
    } - set(activity.entities)
