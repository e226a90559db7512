"""Nodes, entities and loops at their end: what is used, served or woken no more."""

from __future__ import annotations

import functools
from pathlib import Path

from ros2cc_extract.confirm.observations import Observations, Row, Sample
from ros2cc_extract.confirm.outcomes import APART_S, Judgement, Outcome, frame_at, pair
from ros2cc_extract.confirm.schedules import Schedule
from ros2cc_extract.extract.live.hang_analysis.formats import as_text
from ros2cc_extract.extract.live.hang_analysis.frame_waits import Kind
from ros2cc_extract.extract.live.hang_analysis.samples import Activity

_SERVED_NO_MORE, _WHILE_SPUN, _SHUT_DOWN, _FOREIGN_LOOP = 'CC116', 'CC117', 'CC118', 'CC119'
# What rclpy raises where something is used that was destroyed (``destroyable.hpp``), or where all
# was shut down; Jazzy and Kilted.
_GONE = ('InvalidHandle', 'RCLError')
_EXECUTORS = str(Path('rclpy', 'executors.py'))


def served_no_more(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A spin goes on, its executor has nothing to serve, and no callback begins."""
    if schedule.code != _SERVED_NO_MORE or not seen.passed.get(0):
        return None
    after = [each for each in seen.samples if each.at > seen.passed_at]
    if not after or after[-1].at - after[0].at < APART_S:
        return None
    begun = any(at > after[0].at for at, _ in seen.begins)
    if begun or not all(map(_serves_nothing, after)):
        return None
    seconds = after[-1].at - after[0].at
    reason = f'no callback has begun for {seconds:.0f} s and more, and the spin continues'
    return Judgement(Outcome.CONFIRMED, reason, as_text((after[-1].explanation,)))


def _serves_nothing(sample: Sample) -> bool:
    """Whether an executor is spun, and none that is has an entity of the program."""
    look = sample.looks[1]
    spun = [each for each in look.executors if each.spun]
    waits = any(each.wait.kind is Kind.WORK for each in sample.explanation.standings)
    known = look.entities
    served = {number for each in spun for number in each.entities if number in known}
    return waits and bool(spun) and all(known[number].builtin for number in served)


def used_when_gone(schedule: Schedule, seen: Observations) -> Judgement | None:
    """Something that was destroyed is used, by the program or by the spin, and that raises."""
    if schedule.code not in (_SERVED_NO_MORE, _WHILE_SPUN) or not seen.reached.get(0):
        return None
    for row in seen.failed:
        is_after = float(row['at']) >= (seen.reached_at or 0.0)
        is_meant = is_after and row['type'] in _GONE
        place = _place_of_use(schedule, row) if is_meant else None
        if place is not None:
            text = f'{row["type"]}: {row["text"]}'
            return Judgement(Outcome.CONFIRMED, f'{place} raises {row["type"]}', text)
    return None


def _place_of_use(schedule: Schedule, row: Row) -> str | None:
    """The line of the program, or the spin, that an exception comes from; `None` if neither."""
    frames = row['frames']
    of_file = [i for i, each in enumerate(frames) if each[0] == schedule.points[0].file]
    of_spin = [i for i, each in enumerate(frames) if str(each[0]).endswith(_EXECUTORS)]
    # Which calls which: the spin calls the program, or the other way round.
    by_spin = max(of_spin, default=-1) > max(of_file, default=-1)
    if schedule.code == _WHILE_SPUN:
        return 'the spin' if by_spin else None
    return f'line {frames[of_file[-1]][1]}' if of_file and not by_spin else None


def answer_lost(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A call waits for the answer of a client that was destroyed."""
    both = pair(seen)
    if schedule.code != _SERVED_NO_MORE or both is None or not seen.passed.get(0):
        return None
    stood, stand = map(_lost_calls, both)
    for client, line in stand.items():
        if client in stood:
            seconds = both[1].at - both[0].at
            reason = (
                f'line {line} waits for the answer of a client that is gone, for {seconds:.0f} s'
            )
            return Judgement(Outcome.CONFIRMED, reason, as_text((both[1].explanation,)))
    return None


def _lost_calls(sample: Sample) -> dict[tuple[int | None, int], int]:
    """Lines that wait in a call of a client that no node has, by thread and client."""
    known = sample.looks[1].entities
    found = {}
    for each in sample.explanation.standings:
        for frame in each.activity.frames:
            client = frame.objects.get('self')
            is_call = frame.is_in('rclpy.client', 'call')
            if is_call and client is not None and client not in known and not each.moved:
                found[each.activity.ident, client] = each.activity.place.line
    return found


def waits_for_own_end(schedule: Schedule, seen: Observations) -> Judgement | None:
    """A callback shuts down what runs it, and that waits for the end of all callbacks."""
    both = pair(seen)
    if schedule.code != _SHUT_DOWN or both is None:
        return None
    stood, stand = map(functools.partial(_shut_downs, schedule), both)
    if any(now.stands_as(before) for now in stand for before in stood):
        seconds = both[1].at - both[0].at
        reason = f'waits at line {schedule.line} for {seconds:.0f} s and more, for its own end'
        return Judgement(Outcome.CONFIRMED, reason, as_text((both[1].explanation,)))
    return None


def _shut_downs(schedule: Schedule, sample: Sample) -> list[Activity]:
    """Callbacks that wait without a time-out in a shutdown of executors at the first point."""
    return [
        each.activity
        for each in sample.explanation.standings
        if each.in_callback
        and not (each.moved or each.wait.timed)
        and frame_at(each.activity, schedule.points[:1])
        and any(frame.is_in('rclpy.executors', 'shutdown') for frame in each.activity.frames)
    ]


def loop_asleep(schedule: Schedule, seen: Observations) -> Judgement | None:
    """What was put into a loop is ready, and the loop sleeps on."""
    if schedule.code != _FOREIGN_LOOP or seen.reached_at is None or not seen.asleep:
        return None
    begun = seen.reached_at
    before = [each for row in seen.asleep if float(row['at']) < begun for each in row['loops']]
    last = seen.asleep[-1]
    stands = [each for each in last['loops'] if each not in before]
    for earlier in (row for row in seen.asleep if float(row['at']) >= begun):
        seconds = float(last['at']) - float(earlier['at'])
        if seconds >= APART_S and any(each in earlier['loops'] for each in stands):
            reason = (
                f'the loop sleeps for {seconds:.0f} s and more, though line {schedule.line} has '
                'put something into it'
            )
            return Judgement(Outcome.CONFIRMED, reason)
    return None
