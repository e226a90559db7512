"""What came of a finding on the running node, and what all ways of showing it share."""

from __future__ import annotations

import os
from collections.abc import Sequence
from enum import Enum

from ros2cc_extract.confirm.observations import Observations, Sample
from ros2cc_extract.confirm.schedules import Point
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Frame
from ros2cc_extract.light_dataclasses import dataclass

APART_S = 2.0
"""Between the two explanations that must agree."""


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
    :param run: the last steps that the node took, each in words.
    """

    outcome: Outcome
    reason: str
    evidence: str = ''
    run: tuple[str, ...] = ()


def pair(seen: Observations) -> tuple[Sample, Sample] | None:
    """The last sample, and the last one before that is far enough from it."""
    last = seen.samples[-1] if seen.samples else None
    before = [each for each in seen.samples if last and last.at - each.at >= APART_S]
    return (before[-1], last) if last is not None and before else None


def frame_at(activity: Activity, points: Sequence[Point]) -> Frame | None:
    """The innermost frame that stands at one of the points."""
    for frame in reversed(activity.frames):
        if any(each.first <= frame.line <= each.last and _is_of(frame, each) for each in points):
            return frame
    return None


def _is_of(frame: Frame, point: Point) -> bool:
    return os.path.realpath(frame.file) == point.file
