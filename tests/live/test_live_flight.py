"""The flight recorder of a watched process: its last steps are there after whatever ended it."""

from __future__ import annotations

import io
import json
import signal
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest
from child import Child

from ros2cc_extract.extract.live.hook.watch import VARIABLE
from ros2cc_extract.extract.live.run import collect_directory

NODE = """
import threading, time
import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from std_srvs.srv import Trigger

class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.ticks = 0
        self.called = self.create_client(Trigger, 'given')
        self.create_service(Trigger, 'given', lambda request, response: response)
        self.create_timer(0.05, self.tick, callback_group=MutuallyExclusiveCallbackGroup())
        self.create_timer(0.3, self.drive)

    def tick(self):
        self.ticks += 1
        if self.ticks == 20:
            print('ticked', flush=True)
            AT_TWENTY

    def drive(self):
        IN_DRIVE

rclpy.init()
executor = MultiThreadedExecutor(num_threads=2)
executor.add_node(Robot())
SPIN
"""
SPIN = 'executor.spin()'
IN_A_THREAD = 'threading.Thread(target=executor.spin, daemon=True).start()\ntime.sleep(600)'
Start = Callable[..., Child]
Flights = Mapping[str, list[dict[str, Any]]]


def node(folder: Path, *, at_twenty: str = 'pass', drive: str = 'pass', spin: str = SPIN) -> Path:
    path = folder / 'node.py'
    text = NODE.replace('AT_TWENTY', at_twenty).replace('IN_DRIVE', drive)
    path.write_text(text.replace('SPIN', spin))
    return path


@pytest.fixture
def recordings(tmp_path: Path) -> Path:
    folder = tmp_path / 'recordings'
    folder.mkdir()
    return folder


@pytest.fixture
def watched(start: Start, recordings: Path) -> Callable[..., Child]:
    def begin(program: Path, limit_s: float = 60.0) -> Child:
        child = start(program, recorded_into=recordings, **{VARIABLE: f'{limit_s:g}'})
        child.read_until(said('ticked'))
        return child

    return begin


def collected(recordings: Path) -> Flights:
    """Give the slices of each flight record, by why it was kept."""
    output, stderr = recordings.parent / 'live.spec.yaml', io.StringIO()
    assert collect_directory(recordings, output, stderr) == 0
    found = {}
    for path in recordings.parent.glob('live.*.perfetto.json'):
        assert f'{path} shows the last ' in stderr.getvalue()
        found[path.name.split('.')[2]] = json.loads(path.read_text())['traceEvents']
    return found


def slices(events: list[dict[str, Any]], name: str) -> list[str]:
    return [each['ph'] for each in events if each['name'] == name and each['ph'] in 'XB']


def said(word: str) -> Callable[[list[str]], bool]:
    return lambda lines: any(word in line for line in lines)


def count(recordings: Path) -> int:
    return len(list(recordings.glob('*.kept-*')))


def test_steps_before_a_hang_are_kept_once(
    watched: Start, recordings: Path, tmp_path: Path
) -> None:
    stuck = node(tmp_path, drive='self.called.call(Trigger.Request())')
    child = watched(stuck, 0.6)
    child.wait_for(lambda: count(recordings) == 1)
    child.sleep(1.5)
    child.end(signal.SIGKILL)
    flights = collected(recordings)
    assert set(flights) == {'hang-1', 'last'}
    assert set(slices(flights['hang-1'], 'drive')) == {'B'}
    assert slices(flights['hang-1'], 'tick').count('X') >= 20
    assert len(slices(flights['last'], 'tick')) > len(slices(flights['hang-1'], 'tick'))


def test_killed_process_leaves_its_last_steps(
    watched: Start, recordings: Path, tmp_path: Path
) -> None:
    child = watched(node(tmp_path))
    child.sleep(0.6)
    child.end(signal.SIGKILL)
    flights = collected(recordings)
    assert set(flights) == {'last'}
    assert slices(flights['last'], 'tick').count('X') >= 20


def test_signal_keeps_the_steps_and_the_process_goes_on(
    watched: Start, recordings: Path, tmp_path: Path
) -> None:
    child = watched(node(tmp_path))
    # Not even a main thread that never runs Python again is in the way.
    child.process.send_signal(signal.SIGUSR2)
    child.wait_for(lambda: count(recordings) == 1)
    child.process.send_signal(signal.SIGUSR2)
    child.wait_for(lambda: count(recordings) == 2)
    assert child.process.poll() is None
    child.end(signal.SIGKILL)
    assert set(collected(recordings)) == {'signal-1', 'signal-2', 'last'}


@pytest.mark.parametrize('spin', [SPIN, IN_A_THREAD])
def test_steps_before_an_exception_are_kept(
    watched: Start, recordings: Path, tmp_path: Path, spin: str
) -> None:
    child = watched(node(tmp_path, at_twenty="raise ValueError('ball')", spin=spin))
    child.wait_for(lambda: count(recordings) == 1)
    child.end(signal.SIGKILL)
    flights = collected(recordings)
    assert set(flights) - {'last'} == {'exception-1'}
    assert len(slices(flights['exception-1'], 'tick')) >= 19


def test_program_that_ends_as_it_should_leaves_none(
    watched: Start, recordings: Path, tmp_path: Path
) -> None:
    child = watched(node(tmp_path))
    child.end(signal.SIGINT)
    assert collected(recordings) == {}


def test_handler_of_the_program_is_left_as_it_is(
    watched: Start, recordings: Path, tmp_path: Path
) -> None:
    program = node(tmp_path, spin=IN_A_THREAD)
    own = "import signal\nsignal.signal(signal.SIGUSR2, lambda *_: print('own', flush=True))\n"
    program.write_text(own + program.read_text())
    child = watched(program)
    child.process.send_signal(signal.SIGUSR2)
    child.read_until(said('own'))
    child.sleep(0.6)
    assert count(recordings) == 0
    child.end(signal.SIGKILL)
