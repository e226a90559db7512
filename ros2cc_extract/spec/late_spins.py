"""Spins until a future, before callbacks begin, that some releases do not end when it is done."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import Callback, EntityKind, Spec, When

_SPINS_UNTIL = 'spin_until_future_complete'


def late_spins(spec: Spec) -> Iterator[Blocking]:
    """
    Give spins without a time-out until a future that a thread may complete.

    Where no timer has the executor serve something again and again, nothing but that thread ends
    them; of releases that ask for the future only after a callback they may then last forever.
    """
    if any(map(_surely_goes_on, spec.callbacks)):
        return
    for block in spec.set_up:
        is_until = block.call.rpartition('.')[2] == _SPINS_UNTIL
        if is_until and block.foreign and block.seconds is None:
            yield block


def _surely_goes_on(callback: Callback) -> bool:
    """Whether it is a timer that is always there, and that no code stops."""
    is_there = callback.when is When.START and not (callback.conditional or callback.destroyed)
    stops = callback.one_shot or callback.cancelled
    return callback.entity is EntityKind.TIMER and is_there and not stops
