"""A short run of the random programs that wait; ``make random-waits`` runs many."""

from __future__ import annotations

import ast
import os
import sys

import pytest

from tests.random_waits.programs import program
from tests.random_waits.suite import Tally, judge, watch

SEEDS = range(500, 515)


def test_a_seed_gives_one_program() -> None:
    texts = [program(seed) for seed in range(50)]
    assert texts == [program(seed) for seed in range(50)]
    assert len(set(texts)) == 50
    for text in texts:
        ast.parse(text)


@pytest.mark.live
def test_who_hangs_is_never_said_to_end() -> None:
    tally = Tally()
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    for seed, stuck in watch(python, SEEDS).items():
        tally.add(seed, stuck, judge(program(seed)))
    assert tally.programs == len(SEEDS)
    assert tally.hung > 0
    assert tally.missed == []
