"""Units that a loop of asyncio runs: compact texts and slices have the verdicts of the whole."""

from __future__ import annotations

from random import Random

import pytest
from closed_specs import random_loop_unit
from compared_slices import Pair
from compared_texts import Case, Effort, compare
from test_slices_agree import SLICED, WHOLE, no_unit_is_small

from ros2cc_extract.generator.build import Profile
from ros2cc_extract.verify.unit import verify_unit

EFFORT = Effort(states=20_000)
MANY = 400


def texts_differ(numbers: range) -> dict[int, object]:
    found = {}
    for number in numbers:
        random = Random(number)
        unit = random_loop_unit(random, callbacks=4)
        both = compare(number, Case(unit, Profile.RCLPY, random.choice((1, 1, 2))), EFFORT)
        assert both.queries
        if both.differing:
            found[number] = both.differing
    return found


def slices_differ(numbers: range) -> dict[int, object]:
    found: dict[int, object] = {}
    compared = 0
    for number in numbers:
        unit = random_loop_unit(Random(number), callbacks=5)
        with no_unit_is_small():
            sliced = verify_unit(unit, SLICED).results
        whole = verify_unit(unit, WHOLE).results
        pairs = [Pair(*both) for both in zip(sliced, whole, strict=True)]
        compared += sum(not pair.is_skipped for pair in pairs)
        differing = [pair.sliced.words for pair in pairs if not pair.is_skipped and pair.differs]
        if differing:
            found[number] = differing
    assert compared
    return found


def test_texts_agree() -> None:
    assert texts_differ(range(8)) == {}


def test_slices_agree() -> None:
    assert slices_differ(range(6)) == {}


@pytest.mark.slow
def test_texts_agree_on_many() -> None:
    assert texts_differ(range(1_000, 1_000 + MANY)) == {}


@pytest.mark.slow
def test_slices_agree_on_many() -> None:
    assert slices_differ(range(2_000, 2_000 + MANY)) == {}
