"""A limit on time that covers reading: units, foreign models and queries may be large."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2cc_extract.checker.api import Limits
from ros2cc_extract.checker.engines.limits import seconds_reason
from ros2cc_extract.deadline import GRACE_S, TimeOverError, alarm
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place

_AGAIN_S = 1.0


class NotReadError(Exception):
    """The time was over before a model was read."""


@contextmanager
def read_in_time(limits: Limits) -> Iterator[Callable[[], None]]:
    """
    End what makes and reads a model of ours some time after the limit.

    What is given is called once the search has begun, which looks at the clock itself.

    :raises NotReadError: then, or at once where the time is over.
    """
    if limits.is_over:
        raise NotReadError
    seconds = limits.seconds_left
    with alarm(None if seconds is None else seconds + GRACE_S, _AGAIN_S) as disarm:
        if disarm is None:  # an alarm of other code is not ours to handle
            yield _nothing
            return
        try:
            yield disarm
        except TimeOverError:
            raise NotReadError from None


@contextmanager
def limited_reading(limits: Limits, path: Path) -> Iterator[Callable[[], None]]:
    """
    End the reading of a file where the time is over.

    What is given is called once the search has begun, which looks at the clock itself.

    :raises InputError: when the time was over before.
    """
    seconds = limits.seconds_left
    with alarm(seconds, _AGAIN_S) as disarm:
        if seconds is None or disarm is None:
            yield _nothing
            return
        try:
            yield disarm
        except TimeOverError:
            reason = limits.deadline.reason if limits.deadline else seconds_reason(seconds)
            raise InputError(
                f'{reason} before all was read', Place(str(path)), 'give more time by --timeout'
            ) from None


def _nothing() -> None:
    """Nothing waits for it."""
