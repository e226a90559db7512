"""
Random systems judged by their parts and by one network of all; ``make random-systems`` has more.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.random_systems.suite import NOT_SATISFIED, compared


@pytest.mark.parametrize(
    ('seed', 'verdict'),
    [
        (167, NOT_SATISFIED),  # a service that asks itself, and has the name of its method
    ],
)
def test_parts_say_what_the_whole_says(
    seed: int, verdict: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    row = compared(tmp_path, seed)
    assert row == {'seed': seed, 'said': verdict, 'parts': verdict, 'whole': verdict}
