"""Whatever is read: a result or a line that says why not, and nothing run, left behind or dear."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.attack.arena import CANARY, arena
from tests.attack.conftest import Tally
from tests.attack.hostile import CLASSES, drawn

CLASS = 'inputs'


@pytest.mark.parametrize(
    ('kind', 'first', 'rounds'),
    [
        case
        for kind, (_, few, many) in CLASSES.items()
        for case in (
            pytest.param(kind, 0, few, id=kind),
            pytest.param(kind, few, many, marks=pytest.mark.slow, id=f'{kind}, of record'),
        )
    ],
)
def test_hostile_inputs(kind: str, first: int, rounds: int, tmp_path: Path, tally: Tally) -> None:
    """To draw one again: ``drawn(kind, number, canary)``."""
    tally.kind = kind
    told = []
    with arena(tmp_path) as attacked:
        for number in range(first, first + rounds):
            found = attacked.judge(drawn(kind, number, tmp_path / CANARY))
            tally.add()
            if found is not None:
                tally.found[found.kind] += 1
                told.append(f'{kind} {number}: {found.kind}: {found.told}')
    assert not told, '\n\n'.join(told)
