"""Counts, periods and durations from begins and ends."""

from __future__ import annotations

from ros2cc_extract.extract.live.recorder.timings import Timings

MS = 1_000_000


def test_runs_give_periods_and_durations() -> None:
    timings = Timings()
    for begin in (0, 10, 30):
        timings.begin(begin * MS, thread=1)
        timings.end((begin + 2) * MS, thread=1)
    assert timings.describe() == {
        'count': 3,
        'refused': 0,
        'running': 0,
        'threads': 1,
        'period': {'min_s': 0.01, 'median_s': 0.02, 'p99_s': 0.02, 'max_s': 0.02},
        'duration': {'min_s': 0.002, 'median_s': 0.002, 'p99_s': 0.002, 'max_s': 0.002},
    }


def test_overlapping_runs_are_paired_by_thread() -> None:
    timings = Timings()
    timings.begin(0, thread=1)
    timings.begin(1 * MS, thread=2)
    timings.end(5 * MS, thread=1)
    timings.end(7 * MS, thread=2)
    assert list(timings.durations.last) == [5 * MS, 6 * MS]


def test_coroutine_may_end_in_another_thread() -> None:
    timings = Timings()
    timings.begin(0, thread=1)
    timings.end(4 * MS, thread=2)
    assert list(timings.durations.last) == [4 * MS]


def test_end_without_a_begin_is_left_out() -> None:
    timings = Timings()
    timings.end(4 * MS, thread=1)
    assert timings.describe()['duration'] is None


def test_run_that_has_not_ended_is_running() -> None:
    timings = Timings()
    timings.begin(0, thread=1)
    assert timings.describe()['running'] == 1
