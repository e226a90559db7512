"""
How often and how long a callback wants to run, as far as it was stated or measured.

Stated by hand, measured in a live run, or read from the source: the first that is there.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import PAUSES, Blocking
from ros2cc_extract.spec.model import Callback, EntityKind, Spec


@dataclass(frozen=True, kw_only=True)
class Demand:
    """
    What a callback asks for.

    :param period_s: from one arrival to the next.
    :param duration_s: of one run, or the least it may last.
    :param is_least: true when a run may last longer than ``duration_s``.
    :param is_rate_measured: the period is that of the runs of a node, which may have been busy.
    :param slow_s: what one run in a hundred takes at least, where durations were measured.
    """

    period_s: float | None
    duration_s: float | None
    is_least: bool = False
    is_rate_measured: bool = False
    slow_s: float | None = None

    @property
    def is_known(self) -> bool:
        """True when ``load`` is what it asks for, and not just the least."""
        return self.period_s is not None and self.duration_s is not None and not self.is_least

    @property
    def load(self) -> float:
        """Share of the time for which it wants to run, as far as known."""
        if not self.period_s or not self.duration_s:
            return 0.0
        return self.duration_s / self.period_s

    @property
    def slow_load(self) -> float:
        """The same while its runs are slow ones."""
        if not self.period_s or self.slow_s is None:
            return self.load
        return self.slow_s / self.period_s


def demand_of(callback: Callback, specs: Sequence[Spec]) -> Demand:
    """Find out what ``callback`` asks for; timers of ``specs`` may publish what arrives for it."""
    stated = period_of(callback)
    is_heard = stated is None and callback.entity is EntityKind.SUBSCRIPTION
    published = _published_every_s(callback, _publishers(specs)) if is_heard else None
    measured = callback.measured
    seen = measured.period.median_s if measured and measured.period else None
    period = stated if stated is not None else published if published is not None else seen
    duration, is_least = _duration_s(callback)
    return Demand(
        period_s=period,
        duration_s=duration,
        is_least=is_least,
        is_rate_measured=period is not None and stated is None and published is None,
        slow_s=_slow_s(callback),
    )


def period_of(callback: Callback) -> float | None:
    """Seconds between arrivals that are certain to come; none of what comes once, or perhaps."""
    period = callback.period_s
    comes = not callback.conditional and not callback.one_shot and not callback.destroyed
    if not comes or period is None or isinstance(period, Unknown):
        return None
    return period if period > 0 else None


def with_arrivals(units: Sequence[Spec]) -> tuple[Spec, ...]:
    """
    The units, subscriptions with the period of their publishers in any of the units.

    The publisher may be served by another executor, or stand in another program of the sources.
    """
    publishers = _publishers(units)

    def arriving(callback: Callback) -> Callback:
        every = _published_every_s(callback, publishers) if callback.period_s is None else None
        return callback if every is None else replace(callback, period_s=every)

    return tuple(replace(unit, callbacks=tuple(map(arriving, unit.callbacks))) for unit in units)


Publishers = Mapping[str, Mapping[object, Callback]]


def _publishers(specs: Iterable[Spec]) -> Publishers:
    """What publishes which topic; one node may be served in several programs."""
    found: dict[str, dict[object, Callback]] = {}
    for spec in specs:
        for callback in spec.callbacks:
            known = callback.source or (spec.name, callback.name), callback.function
            for topic in {act.name for act in callback.publishes if isinstance(act.name, str)}:
                found.setdefault(topic, {})[known] = callback
    return found


def _published_every_s(callback: Callback, publishers: Publishers) -> float | None:
    """The period of the one timer that publishes the topic of a subscription."""
    topic = callback.key
    if callback.entity is not EntityKind.SUBSCRIPTION or not isinstance(topic, str):
        return None
    found = list(publishers.get(topic, {}).values())
    return period_of(found[0]) if len(found) == 1 else None


def _duration_s(callback: Callback) -> tuple[float | None, bool]:
    """Seconds of one run, and whether that is only the least: what its sleeps alone take."""
    if callback.duration_s is not None:
        return callback.duration_s, False
    if callback.measured is not None and callback.measured.duration is not None:
        return callback.measured.duration.median_s, False
    return least_slept_s(callback.blocking), True


def least_slept_s(blocking: Iterable[Blocking]) -> float:
    """Seconds that a run sleeps on every branch."""
    slept = [b for b in blocking if b.call in PAUSES and not b.conditional]
    return sum(b.seconds * b.times for b in slept if isinstance(b.seconds, (int, float)))


def _slow_s(callback: Callback) -> float | None:
    """Seconds of a slow run, where no duration was stated."""
    measured = callback.measured
    if callback.duration_s is not None or measured is None or measured.duration is None:
        return None
    return measured.duration.p99_s
