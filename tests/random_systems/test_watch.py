"""Who watches a system: its processes stay until the last of them was looked at."""

from __future__ import annotations

import os
import threading
from pathlib import Path

import pytest

from tests.random_waits import watch


def test_a_process_stays_until_all_of_its_system_were_looked_at(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / 'out'
    ends: list[int] = []

    def lines() -> list[str]:
        return out.read_text(encoding='utf-8').splitlines()

    def other_is_looked_at() -> None:
        with out.open('a', encoding='utf-8') as stream:
            stream.write('{}\n')

    monkeypatch.setattr(watch, 'wait_for_spin', lambda latest: None)
    monkeypatch.setattr(watch, 'standing', lambda file: {})
    monkeypatch.setattr(watch, 'LONGEST_S', watch.LOOKS_S)
    monkeypatch.setattr(os, '_exit', lambda status: ends.append(len(lines())))
    late = threading.Timer(6 * watch.LOOKS_S, other_is_looked_at)
    late.start()
    watch.watch('a.py', str(out), 2)
    late.join()
    assert ends == [2]
