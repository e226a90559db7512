"""Executions of random programs on real executors are paths of their models; the short version."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Trace
from tests.conformance.checking import Ran, compare_in_time, compare_one
from tests.conformance.planted import PLANTED
from tests.conformance.programs import EVENTS_FIRST, WRITTEN_BY_HAND
from tests.conformance.suite import own_environment, run_programs

pytestmark = pytest.mark.live

BY_HAND = tuple(-n - 1 for n in range(len(WRITTEN_BY_HAND)))
#: Seeds that have once been no paths of the model, or not recorded as they were.
REGRESSIONS = (
    3,
    103,
    105,
    114,
    119,
    124,
    201,
    214,
    252,
    256,
    265,
    271,
    362,
    403,
    1407,
    1512,
    6016,
    6106,
    20087,
    20133,
)
FRESH = tuple(range(500, 512))
#: How often the programs written by hand are run at most.
RECORDINGS = 5
ON_EVENTS = tuple(range(EVENTS_FIRST, EVENTS_FIRST + 8))
Recorded = tuple[Trace, list[Ran]]


@pytest.fixture(scope='module')
def python() -> str:
    """Give an interpreter that imports rclpy; skip where there is none."""
    named = os.environ.get('ROS2CC_RCLPY_PYTHON', sys.executable)
    tried = subprocess.run([named, '-c', 'import rclpy'], capture_output=True, check=False)
    if tried.returncode:
        pytest.skip(f'no rclpy in {named}; set ROS2CC_RCLPY_PYTHON to one that has it')
    return named


@dataclass
class Recordings:
    """Runs of the programs written by hand, made as they are asked for and kept."""

    python: str
    folder: Path
    made: list[Recorded] = field(default_factory=list)

    def __iter__(self) -> Iterator[Recorded]:
        for number in range(RECORDINGS):
            if number == len(self.made):
                folder = self.folder / str(number)
                folder.mkdir()
                with own_environment() as environment:
                    self.made.append(run_programs(self.python, BY_HAND, environment, folder))
            yield self.made[number]


@pytest.fixture(scope='module')
def by_hand(python: str, tmp_path_factory: pytest.TempPathFactory) -> Recordings:
    return Recordings(python, tmp_path_factory.mktemp('by_hand'))


def outcomes(recorded: Recorded) -> set[tuple[int, Outcome]]:
    trace, ran = recorded
    return {(each.seed, compare_in_time(trace, each)[0].answer.outcome) for each in ran}


def all_conform(recorded: Recorded) -> set[tuple[int, Outcome]]:
    return {(each.seed, Outcome.CONFORMS) for each in recorded[1]}


@pytest.mark.parametrize(
    'seeds', [REGRESSIONS, FRESH, ON_EVENTS], ids=['regressions', 'fresh', 'on_events']
)
def test_executions_are_paths_of_the_model(
    python: str, seeds: tuple[int, ...], tmp_path: Path
) -> None:
    with own_environment() as environment:
        recorded = run_programs(python, seeds, environment, tmp_path)
    assert len(recorded[1]) == len(seeds)
    assert outcomes(recorded) == all_conform(recorded)


def test_programs_written_by_hand_are_paths_of_the_model(by_hand: Recordings) -> None:
    recorded = next(iter(by_hand))
    assert outcomes(recorded) == all_conform(recorded)


@pytest.mark.parametrize(('plant', 'seed'), PLANTED)
def test_a_wrong_model_is_rejected(
    plant: Callable[[str], str], seed: int, by_hand: Recordings
) -> None:
    """By one of a few runs: one of a machine that stood still may look as the wrong model says."""
    assert Outcome.DIVERGES in (outcome_under(plant, seed, recorded) for recorded in by_hand)


def outcome_under(plant: Callable[[str], str], seed: int, recorded: Recorded) -> Outcome:
    trace, ran = recorded
    (program,) = (each for each in ran if each.seed == seed)
    return compare_one(trace, program, plant).answer.outcome
