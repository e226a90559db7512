"""Runs of one callback that hold each other up: in the model, and on real rclpy."""

from __future__ import annotations

import os
import sys

import pytest

from tests.random_waits.crowding import END, HANG
from tests.random_waits.suite import ENDS, FOUND, judge, stuck_in_files


@pytest.mark.parametrize('name', HANG)
def test_who_fills_the_threads_with_runs_of_its_own_is_said_to_hang(name: str) -> None:
    assert judge(HANG[name])['ask'] == FOUND


@pytest.mark.parametrize('name', END)
def test_who_never_overlaps_itself_is_said_to_end(name: str) -> None:
    assert judge(END[name])['ask'] == ENDS


@pytest.mark.slow
@pytest.mark.live
def test_real_executors_do_as_the_model_says() -> None:
    texts = {f'hang_{name}': text for name, text in HANG.items()}
    texts |= {f'end_{name}': text for name, text in END.items()}
    python = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    assert {name for name, stuck in stuck_in_files(python, texts).items() if stuck} == {
        f'hang_{name}' for name in HANG
    }
