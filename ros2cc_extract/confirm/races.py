"""Data races: what one thread wrote over, shown by its values."""

from __future__ import annotations

from ros2cc_extract.confirm.observations import Observations
from ros2cc_extract.confirm.outcomes import Judgement, Outcome
from ros2cc_extract.confirm.schedules import Schedule


def raced(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    What was read no longer held when it was written: what another thread wrote is lost.
    """
    race = schedule.race
    if race is None:
        return None
    # Where nothing was read before, the last of two writes wins.
    key = 'lost' if schedule.code == 'CC302' else 'stale'
    for row in seen.raced:
        if row[key]:
            reason = (
                f'{race.attribute} was {row["read"]} when line {schedule.line} had read it, '
                f'another thread set it to {row["other"]}, and line {schedule.line} then to '
                f'{row["own"]}'
            )
            return Judgement(Outcome.CONFIRMED, reason)
    return None
