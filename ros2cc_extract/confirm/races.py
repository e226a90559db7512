"""Data races: what one thread wrote over, shown by its values."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.confirm.observations import Observations, Row
from ros2cc_extract.confirm.outcomes import Judgement, Outcome
from ros2cc_extract.confirm.schedules import CLEARED, Schedule


def raced(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    What was read no longer held when it was written: what another thread wrote is lost.
    """
    if schedule.code == CLEARED:
        return None
    shown = next((row for row in _shown(schedule, seen) if row['let_in']), None)
    return Judgement(Outcome.CONFIRMED, _reason(schedule, shown)) if shown else None


def used_when_cleared(schedule: Schedule, seen: Observations) -> Judgement | None:
    """What was tested was set to None by another thread, and its use has raised."""
    if schedule.code != CLEARED:
        return None
    held = {row['thread'] for row in _shown(schedule, seen)}
    for row in seen.raised:
        is_of_none = row['type'] in ('AttributeError', 'TypeError') and 'NoneType' in row['text']
        if row['point'] == 0 and is_of_none and row['thread'] in held:
            attribute = schedule.race.attribute if schedule.race else ''
            reason = (
                f'another thread set {attribute} to None after it was tested, and line '
                f'{schedule.line} raises {row["type"]}'
            )
            return Judgement(Outcome.CONFIRMED, reason, f'{row["type"]}: {row["text"]}')
    return None


def forced_only(schedule: Schedule, seen: Observations) -> Judgement | None:
    """
    It was shown, but only by a switch of threads that Python with its global lock does not make.

    Between the read and the write there is no call and no loop; see ``steering/instructions.py``.
    """
    shown = next(_shown(schedule, seen), None)
    if shown is None or schedule.code == CLEARED:
        return None
    why = 'held there by force: Python with its global lock lets no other thread in between'
    return Judgement(Outcome.NOT_REACHED, f'{_reason(schedule, shown)}; {why}')


def _shown(schedule: Schedule, seen: Observations) -> Iterator[Row]:
    # Where nothing was read before, the last of two writes wins.
    key = 'lost' if schedule.code == 'CC302' else 'stale'
    if schedule.race is not None:
        yield from (row for row in seen.raced if row[key])


def _reason(schedule: Schedule, row: Row) -> str:
    attribute = schedule.race.attribute if schedule.race else ''
    return (
        f'{attribute} was {row["read"]} before line {row["line"]}, another thread set it to '
        f'{row["other"]}, and line {row["line"]} then to {row["own"]}'
    )
