"""Programs that are written down conform to what is scanned of them and to what the hook saw."""

from __future__ import annotations

from pathlib import Path

import pytest

from ros2cc_extract.conform.search import Outcome
from tests.conformance.programs import draw
from tests.conformance.test_conformance import python as python
from tests.conformance.three import run_program, told

pytestmark = pytest.mark.live


@pytest.mark.parametrize(
    ('seed', 'live'),
    [
        (410_001, Outcome.UNDECIDED),  # a coroutine awaits
        (400_000, Outcome.CONFORMS),
        (400_001, Outcome.CONFORMS),
    ],
)
def test_each_specification_of_a_program_has_its_execution(
    python: str, seed: int, live: Outcome, tmp_path: Path
) -> None:
    trace, units = run_program(python, draw(seed), tmp_path)
    outcomes = {kind: told(trace, units[kind])[0] for kind in units}
    conforms = Outcome.CONFORMS.value
    assert outcomes == {'by hand': conforms, 'scanned': conforms, 'live': live.value}
