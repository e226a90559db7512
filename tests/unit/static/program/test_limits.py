"""A scan leaves the collector of the process as it was."""

from __future__ import annotations

import gc
import weakref

import pytest

from ros2cc_extract.extract.static.program import runtime_limits
from ros2cc_extract.extract.static.program.runtime_limits import scanning_limits


def test_the_collector_is_on_again_and_nothing_is_kept_from_it() -> None:
    frozen = gc.get_freeze_count()
    with scanning_limits():
        assert not gc.isenabled()
    assert gc.isenabled()
    assert gc.get_freeze_count() == frozen


def test_what_the_process_keeps_from_the_collector_stays_kept() -> None:
    gc.freeze()
    try:
        with scanning_limits():
            pass
        assert gc.get_freeze_count() > 0
    finally:
        gc.unfreeze()


def test_a_collector_that_was_off_stays_off() -> None:
    gc.disable()
    try:
        with scanning_limits():
            pass
        assert not gc.isenabled()
    finally:
        gc.enable()


class Ring:
    """Something that only the collector frees."""

    def __init__(self) -> None:
        self.self = self


def test_what_earlier_scans_left_behind_is_freed_once_it_is_much(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(runtime_limits, '_MUCH', 1_000)
    with scanning_limits():
        left_behind = [weakref.ref(ring) for ring in [Ring() for _ in range(2_000)]]
    with scanning_limits():
        assert not any(ring() for ring in left_behind)


def test_what_a_program_left_behind_is_freed_before_the_next_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(runtime_limits, '_MUCH', 1_000)
    with scanning_limits():
        left_behind = [weakref.ref(ring) for ring in [Ring() for _ in range(2_000)]]
        runtime_limits.forget_programs()
        assert not any(ring() for ring in left_behind)
