"""Whatever happens, and whatever happens to the hook, the program runs as it does without it."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path

import pytest
from child import Child
from conftest import EXAMPLES
from recorded import PROGRAMS, recordings_in, timers_of, written

from ros2cc_extract.extract.live.recordings.collect import specs_of
from ros2cc_extract.extract.live.recordings.trace import read_trace

Start = Callable[..., Child]
FULL = 'File too large'
RAISED = 'RuntimeError: the arm is stuck\n'


@pytest.mark.parametrize(
    ('program', 'arguments'),
    [('outliving.py', []), ('busy_forks.py', []), ('awaiting.py', [])],
)
def test_program_ends_alike_with_the_hook_and_a_trace(
    program: str, arguments: list[str], start: Start, tmp_path: Path
) -> None:
    without = start(PROGRAMS / program, *arguments)
    status = without.end()
    child = start(PROGRAMS / program, *arguments, recorded_into=tmp_path, traced=True)
    assert (child.end(), child.text) == (status, without.text)
    assert {(each.losses, each.ended) for each in recordings_in(tmp_path)} == {(0, True)}


@pytest.mark.parametrize('threads', ['1', '2'])
def test_exception_of_a_callback_ends_the_program_as_before(
    threads: str, start: Start, tmp_path: Path
) -> None:
    without = start(PROGRAMS / 'raising.py', threads)
    status = without.end()
    child = start(PROGRAMS / 'raising.py', threads, recorded_into=tmp_path, traced=True)
    assert child.end() == status == 1
    # Two threads may raise it twice, and rclpy reports later what was not asked for.
    assert RAISED in child.lines
    assert RAISED in without.lines
    (recording,) = recordings_in(tmp_path)
    (unit,) = specs_of(recording)
    assert [callback.function_name for callback in written(unit)] == ['tick']


def test_ctrl_c_that_nobody_handles_ends_the_program(start: Start, tmp_path: Path) -> None:
    child = start(PROGRAMS / 'waiting.py', '1', '1', recorded_into=tmp_path)
    child.read_until(lambda lines: 'tick\n' in lines)
    # KeyboardInterrupt, or an error of the executor: with or without us a race within rclpy.
    assert child.end(signal.SIGINT) in (-signal.SIGINT, 1)
    assert [recording.ended for recording in recordings_in(tmp_path)] == [True]


def test_termination_that_the_program_handles_ends_it_as_before(
    start: Start, tmp_path: Path
) -> None:
    child = start(EXAMPLES / 'two_groups' / 'node.py', recorded_into=tmp_path)
    child.read_until(lambda lines: any('planned' in line for line in lines))
    child.end_well(signal.SIGTERM)
    assert [recording.ended for recording in recordings_in(tmp_path)] == [True]


@pytest.mark.parametrize('hooked', [False, True])
def test_termination_that_nobody_handles_ends_the_program_as_before(
    hooked: bool, start: Start, tmp_path: Path
) -> None:
    recorded_into = tmp_path if hooked else None
    child = start(PROGRAMS / 'waiting.py', '1', '1', recorded_into=recorded_into)
    child.read_until(lambda lines: 'tick\n' in lines)
    status = child.end(signal.SIGTERM)
    # Which of the three it is depends on where the executor was when its context went away.
    assert (status, child.lines[-1].partition(':')[0].strip()) in {
        (0, 'tick'),
        (1, 'rclpy.executors.ExternalShutdownException'),
        (1, 'rclpy._rclpy_pybind11.RCLError'),
    }


def test_killed_process_leaves_a_whole_recording(start: Start, tmp_path: Path) -> None:
    child = start(PROGRAMS / 'waiting.py', '50', '40', recorded_into=tmp_path)
    child.wait_for(lambda: sum(map(timers_of, recordings_in(tmp_path))) == 2001)
    assert child.end(signal.SIGKILL) == -signal.SIGKILL
    (recording,) = recordings_in(tmp_path)
    (unit,) = specs_of(recording)
    assert not recording.ended
    assert (len(unit.nodes), len(written(unit))) == (50, 2001)


def test_process_that_vanishes_by_os_exit_has_been_recorded(start: Start, tmp_path: Path) -> None:
    child = start(PROGRAMS / 'vanishing.py', str(tmp_path), recorded_into=tmp_path, traced=True)
    assert (child.end(), child.text) == (3, '')
    (recording,) = recordings_in(tmp_path)
    assert [spec.nodes for spec in specs_of(recording)] == [('left_behind',)]
    assert not recording.ended
    trace = read_trace(recording)
    assert trace is not None
    assert 'begin' in {event.event for event in trace.events()}


def test_two_processes_write_into_one_directory(start: Start, tmp_path: Path) -> None:
    first, second = (
        start(PROGRAMS / 'own_classes.py', recorded_into=tmp_path, traced=True) for _ in range(2)
    )
    assert (first.end(), second.end()) == (0, 0)
    assert [specs_of(each)[0].nodes for each in recordings_in(tmp_path)] == [('careful',)] * 2


@pytest.mark.parametrize('folder', ['missing', 'a file'])
def test_recording_that_cannot_be_written_is_told_once(
    folder: str, start: Start, tmp_path: Path
) -> None:
    (tmp_path / 'a file').write_text('')
    child = start(PROGRAMS / 'waiting.py', '1', '1', recorded_into=tmp_path / folder)
    complaint = 'the node runs on, its recording is tried again every 5 s'
    child.read_until(lambda lines: any(complaint in line for line in lines))
    ticks = child.text.count('tick')
    child.read_until(lambda lines: sum('tick' in line for line in lines) > ticks + 3)
    child.end(signal.SIGINT)
    assert child.text.count(complaint) == 1


def test_disk_that_fills_up_is_told_and_the_node_runs_on(start: Start, tmp_path: Path) -> None:
    child = start(PROGRAMS / 'full_disk.py', recorded_into=tmp_path, traced=True)
    child.read_until(lambda lines: sum(FULL in line for line in lines) == 2)
    ticks = child.text.count('tick')
    child.read_until(lambda lines: sum('tick' in line for line in lines) > ticks + 3)
    child.end(signal.SIGTERM)
    told = [line.partition('.json')[2] for line in child.lines if FULL in line]
    assert sorted(told) == [
        f'.events: {FULL}; the node runs on without its trace\n',
        f': {FULL}; the node runs on, its recording is tried again every 5 s\n',
    ]
    assert not list(tmp_path.glob('*.new'))


@pytest.mark.parametrize(
    ('what', 'program', 'native'),
    [
        (what, program, native)
        for what, program in [
            *((what, 'moving_nodes.py') for what in ('notes', 'entities', 'lock', 'writer')),
            ('entities', 'awaiting.py'),
        ]
        for native in '01'
    ]
    # In C these have no parts that could be broken.
    + [(what, 'awaiting.py', '0') for what in ('journal', 'clock')]
    + [('journal', 'moving_nodes.py', '0')],
)
def test_broken_hook_changes_nothing_but_the_count_of_losses(
    what: str, program: str, native: str, start: Start, tmp_path: Path
) -> None:
    without = start(PROGRAMS / program)
    without.end()
    child = start(
        PROGRAMS / 'broken_hook.py',
        what,
        program,
        recorded_into=tmp_path,
        traced=True,
        ROS2CC_LIVE_NATIVE=native,
    )
    assert (child.end(), child.text) == (0, f'{without.text}lost True\n')
    if what not in ('lock', 'writer'):
        (recording,) = recordings_in(tmp_path)
        assert recording.losses
        assert recording.last_losses[-1] == "RuntimeError('broken on purpose')"
