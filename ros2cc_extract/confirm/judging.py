"""What was seen, and whether that is what the finding says."""

from __future__ import annotations

from collections.abc import Callable

from ros2cc_extract.confirm.ends import (
    answer_lost,
    loop_asleep,
    served_no_more,
    used_when_gone,
    waits_for_own_end,
)
from ros2cc_extract.confirm.hangs import crossed_locks, hang, kept_lock, timed_out
from ros2cc_extract.confirm.observations import Observations
from ros2cc_extract.confirm.outcomes import Judgement, Outcome
from ros2cc_extract.confirm.races import forced_only, raced, used_when_cleared
from ros2cc_extract.confirm.schedules import Schedule
from ros2cc_extract.confirm.spins import (
    asleep_beside,
    exception,
    nested,
    node_lost,
    shut_out,
)
from ros2cc_extract.extract.live.hang_analysis.formats import as_text

_WAYS: tuple[Callable[[Schedule, Observations], Judgement | None], ...] = (
    hang,
    exception,
    nested,
    node_lost,
    shut_out,
    asleep_beside,
    kept_lock,
    crossed_locks,
    timed_out,
    raced,
    used_when_cleared,
    served_no_more,
    used_when_gone,
    answer_lost,
    waits_for_own_end,
    loop_asleep,
)


def confirmed(schedule: Schedule, seen: Observations) -> Judgement | None:
    """Judge while the node runs: `None` until something is shown."""
    return next((found for way in _WAYS if (found := way(schedule, seen)) is not None), None)


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
    forced = forced_only(schedule, seen)
    if forced is not None:
        return forced
    if seen.alone and not seen.raced:
        reason = f'nobody else wrote while line {schedule.line} was held, {seen.alone} times'
        return Judgement(Outcome.NOT_REACHED, reason)
    if schedule.forever and seen.passed.get(0):
        reason = f'the wait at line {schedule.line} ended; the model says that it never does'
        return Judgement(Outcome.CONTRADICTED, reason, _last_look(seen))
    reason = 'was reached, but nothing was shown'
    if seen.handed:
        functions = ', '.join(seen.handed)
        reason += f'; a module that is stood in for was given {functions}, and might call it'
    if schedule.runs_inside and not seen.raised:
        reason = 'was reached; no other callback was run inside, and this release raises nothing'
    return Judgement(Outcome.NOT_REACHED, reason, _last_look(seen))


def _last_look(seen: Observations) -> str:
    return as_text((seen.samples[-1].explanation,)) if seen.samples else ''


def _missing_module(said: str) -> str | None:
    for line in reversed(said.splitlines()):
        if line.startswith('ModuleNotFoundError: No module named '):
            return line.rpartition(' ')[2].strip("'")
    return None


def _last(said: str) -> str:
    return '\n'.join([line for line in said.splitlines() if line.strip()][-3:])
