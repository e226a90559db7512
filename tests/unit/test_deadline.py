"""Alarms that end what still runs."""

from __future__ import annotations

import gc
import math
import signal
import time
from collections.abc import Iterator

import pytest

from ros2cc_extract.deadline import TimeOverError, alarm


def test_a_limit_that_never_comes_sets_no_alarm() -> None:
    with alarm(math.inf, 1.0) as disarm:
        assert disarm is None
    with alarm(60.0, 1.0) as disarm:
        assert disarm is not None
        assert signal.getitimer(signal.ITIMER_REAL)[0] > 0
    assert signal.getitimer(signal.ITIMER_REAL)[0] == 0


@pytest.fixture
def _slow_collector() -> Iterator[None]:
    """The alarm rings during a callback of the garbage collector."""

    def hear(phase: str, info: dict[str, int]) -> None:
        begun = time.monotonic()
        while phase == 'stop' and time.monotonic() < begun + 0.2:
            pass

    gc.callbacks.append(hear)
    yield
    gc.callbacks.remove(hear)


@pytest.mark.usefixtures('_slow_collector')
def test_an_alarm_beside_the_garbage_collector_is_not_lost() -> None:
    def collects() -> bool:
        """It comes through that, and is ended behind it."""
        gc.collect()
        time.sleep(30.0)
        return True

    gc.collect()  # a finalizer of an earlier test's garbage would take the alarm with it
    with pytest.raises(TimeOverError), alarm(0.05, 60.0):
        collects()
