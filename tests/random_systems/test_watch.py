"""Who watches a system: its processes are looked at while all of them are served."""

from __future__ import annotations

import os
import threading
import time
from pathlib import Path

import pytest

from tests.random_waits import watch


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """When the process was looked at; it does nothing else, and never ends."""
    times: list[float] = []
    monkeypatch.setattr(watch, 'wait_for_spin', lambda latest: None)
    monkeypatch.setattr(watch, 'standing', lambda file: times.append(time.monotonic()) or {})
    monkeypatch.setattr(watch, 'LONGEST_S', watch.LOOKS_S)
    monkeypatch.setattr(os, '_exit', lambda status: None)
    return times


def after(seconds: float, path: Path) -> threading.Timer:
    """Another process of the system writes its line."""

    def write() -> None:
        with path.open('a', encoding='utf-8') as stream:
            stream.write('{}\n')

    timer = threading.Timer(seconds, write)
    timer.start()
    return timer


def test_a_process_is_not_looked_at_before_all_are_served(
    tmp_path: Path, looks: list[float]
) -> None:
    """What asks a process that is not spun yet would stand still, and only so long."""
    out = tmp_path / 'out'
    out.write_text('{}\n')
    begun = time.monotonic()
    late = after(6 * watch.LOOKS_S, watch.spun(str(out)))
    watch.watch('a.py', str(out), 2)
    late.join()
    assert looks
    assert min(looks) - begun >= 6 * watch.LOOKS_S


def test_a_process_stays_until_all_of_its_system_were_looked_at(
    tmp_path: Path, looks: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / 'out'
    ends: list[int] = []

    def lines() -> list[str]:
        return out.read_text(encoding='utf-8').splitlines()

    monkeypatch.setattr(os, '_exit', lambda status: ends.append(len(lines())))
    watch.spun(str(out)).write_text('{}\n')
    late = after(6 * watch.LOOKS_S, out)
    watch.watch('a.py', str(out), 2)
    late.join()
    assert ends == [2]
