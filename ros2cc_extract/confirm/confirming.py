"""Confirms one finding: starts its node, watches it, and judges."""

from __future__ import annotations

import time
from dataclasses import replace

from ros2cc_extract.confirm.judging import confirmed, not_confirmed
from ros2cc_extract.confirm.observations import Observations
from ros2cc_extract.confirm.outcomes import Judgement, Outcome
from ros2cc_extract.confirm.processes import started
from ros2cc_extract.confirm.recorded_runs import recorded_run
from ros2cc_extract.confirm.schedules import Schedule
from ros2cc_extract.light_dataclasses import dataclass

LIMIT_S = 30.0
# Give up when a thread was held before a write this often, and no other one wrote.
MOST_TRIES = 8
_OF_IMPORTS = ('ModuleNotFoundError', 'ImportError')
_READ_EVERY_S = 0.1
# After its last words the program may have ended by what was to be shown.
_AFTER_END_S = 0.3


@dataclass(frozen=True)
class Confirmation:
    """
    :param seconds: how long it took.
    """

    schedule: Schedule
    judgement: Judgement
    seconds: float


def confirm(
    schedule: Schedule, python: str, limit_s: float = LIMIT_S, *, stubs: bool = False
) -> Confirmation:
    """
    Run the program of a schedule until its finding is shown, or the time is over.

    :param stubs: stand-ins for modules that are not installed.
    :raises InputError, ToolNotFoundError: as ``started``.
    """
    begun = time.monotonic()
    judgement, raised = _watch(schedule, python, begun + limit_s, stubs)
    # It does not stand messages of defaults, as a text that is to be a number, or those that are
    # filled, as a map of two by two cells that are not there.
    for other in (replace(schedule, defaults=False), replace(schedule, filled=False)):
        if raised and judgement.outcome is not Outcome.CONFIRMED:
            schedule = other
            judgement, raised = _watch(schedule, python, begun + limit_s, stubs)
    return Confirmation(schedule, judgement, time.monotonic() - begun)


def _watch(
    schedule: Schedule, python: str, deadline: float, stubs: bool
) -> tuple[Judgement, bool]:
    """Also say whether the program has ended by an exception."""
    seen = Observations()
    with started(schedule, python, stubs=stubs) as node:
        while True:
            ended = node.process.poll() is not None
            if ended:
                time.sleep(_AFTER_END_S)
            if seen.update(node.report):
                found = confirmed(schedule, seen)
                if found is not None:
                    return replace(found, run=recorded_run(schedule, seen.steps)), False
            in_vain = seen.alone >= MOST_TRIES
            if ended or in_vain or time.monotonic() > deadline:
                found = not_confirmed(schedule, seen, node.said, ended=ended)
                raised = any(row['type'] not in _OF_IMPORTS for row in seen.failed)
                return replace(found, run=recorded_run(schedule, seen.steps)), ended and raised
            time.sleep(_READ_EVERY_S)
