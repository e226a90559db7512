"""Alarms that end what still runs."""

from __future__ import annotations

import math
import signal

from ros2cc_extract.deadline import alarm


def test_a_limit_that_never_comes_sets_no_alarm() -> None:
    with alarm(math.inf, 1.0) as disarm:
        assert disarm is None
    with alarm(60.0, 1.0) as disarm:
        assert disarm is not None
        assert signal.getitimer(signal.ITIMER_REAL)[0] > 0
    assert signal.getitimer(signal.ITIMER_REAL)[0] == 0
