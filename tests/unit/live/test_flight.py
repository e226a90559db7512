"""The flight recorder forgets what is long over, and nothing else."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2cc_extract.extract.live.hook import flight
from ros2cc_extract.extract.live.hook.flight import KEPT_S, MOST_COPIES, FlightRecorder
from ros2cc_extract.extract.live.recorder.events import BEGIN, END, Fields, rows
from ros2cc_extract.extract.live.recorder.record import Recorder
from ros2cc_extract.extract.live.recorder.timings import Timings

ENTITY, THREAD = 7, 42
LONGEST_S = 10.0
# Seconds from one step to the next, each a begin or an end in turn.
PAUSES = st.lists(st.floats(0.0, LONGEST_S), min_size=1, max_size=30)


@pytest.fixture(scope='module')
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp('flight')


def kept(path: Path) -> list[Fields]:
    return [fields for fields, name in rows(path.read_bytes()) if not name]


@given(pauses=PAUSES)
def test_what_is_kept(pauses: list[float], folder: Path) -> None:
    recorder = Recorder()
    recorder._timings[ENTITY] = Timings()
    recorded = FlightRecorder(recorder)
    recorded.begin(str(folder / 'process.json'))
    clock, steps = 1000.0, []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(flight.time, 'monotonic', lambda: clock)
        for pause, what in zip(pauses, itertools.cycle((BEGIN, END)), strict=False):
            clock += pause
            step = round(clock * 1e9), THREAD, what, ENTITY
            steps.append(step)
            recorder.journal.put(*step)
            recorded.write(recorder.take_events())
        recorded.keep('signal')
    found = kept(folder / 'process.kept-signal-1.events')
    begun = steps[-1] if steps[-1][2] == BEGIN else None
    recent = [step for step in steps if step[0] > (clock - KEPT_S) * 1e9]
    assert set(recent) <= set(found) <= set(steps)
    assert begun is None or begun in found
    # Only what had begun when the older file was begun anew is older.
    older = [step for step in found if step[0] < (clock - 2 * (KEPT_S + LONGEST_S)) * 1e9]
    assert {step[2] for step in older} <= {BEGIN}


def test_disk_is_not_filled_by_copies(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorded = FlightRecorder(Recorder())
    recorded.begin(str(tmp_path / 'process.json'))
    for _ in range(MOST_COPIES + 5):
        recorded.keep('hang')
    assert len(list(tmp_path.glob('process.kept-hang-*'))) == MOST_COPIES
    assert capsys.readouterr().err.count('are kept in') == MOST_COPIES


def test_folder_that_is_gone_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    recorded = FlightRecorder(Recorder())
    recorded.begin(str(tmp_path / 'gone' / 'process.json'))
    recorded.keep('hang')
    said = 'the last steps before the hang cannot be kept: No such file or directory'
    assert capsys.readouterr().err == f'ros2cc-extract: {said}\n'
