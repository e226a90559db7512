"""A process that was started without the hook reports what it holds, and goes on."""

from __future__ import annotations

import io
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from child import Child
from expectations import EXPECTED
from held import of_spec, without_unknown_keys

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live import injection
from ros2cc_extract.extract.live.attach import attach_process
from ros2cc_extract.extract.live.injection import inject, injectors
from ros2cc_extract.extract.live.thread_choice import tracer_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.yaml.yaml_io import load_specs
from tests.live.entries import enter_often

RUNS_FOR_EVER = 'import time\nprint(flush=True)\nwhile True:\n    time.sleep(0.01)\n'


@pytest.fixture(scope='module')
def a_way_in(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Skip where nothing can enter another process: no injector, or the system forbids it."""
    script = tmp_path_factory.mktemp('way_in') / 'nothing.py'
    script.write_text('')
    command = [sys.executable, '-c', RUNS_FOR_EVER]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as other:
        assert other.stdout is not None
        # An interpreter that is still being set up would crash.
        other.stdout.readline()
        try:
            inject(other.pid, script, injectors())
        except ToolNotFoundError as error:
            pytest.skip(str(error))
        finally:
            other.kill()


needs_a_way_in = pytest.mark.usefixtures('a_way_in')


def wait_until(is_so: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 30.0
    while not is_so() and time.monotonic() < deadline:
        time.sleep(0.02)
    assert is_so()


def attach(child: Child, folder: Path) -> Spec:
    output = folder / 'attached.yaml'
    assert attach_process(child.process.pid, output, io.StringIO()) == 0
    (spec,) = load_specs(output)
    return spec


@needs_a_way_in
@pytest.mark.parametrize(
    ('name', 'says'),
    [('action_server', 'goals done'), ('lambda_in_loop', 'alpha')],
)
def test_running_process_tells_what_it_holds_and_goes_on(
    name: str, says: str, start_example: Callable[..., Child], tmp_path: Path
) -> None:
    child = start_example(name)
    child.read_until(lambda lines: any(says in line for line in lines))
    spec = attach(child, tmp_path)
    expected = without_unknown_keys(EXPECTED[name], of_spec(spec))
    assert of_spec(spec) == expected
    before = len(child.lines)
    child.read_until(lambda lines: any(says in line for line in lines[before:]))
    child.end_well(signal.SIGINT)


@needs_a_way_in
def test_action_server_without_a_name_is_unknown_and_has_its_execute_callback(
    start_example: Callable[..., Child], tmp_path: Path
) -> None:
    child = start_example('action_server')
    child.read_until(lambda lines: any('goals done' in line for line in lines))
    spec = attach(child, tmp_path)
    server, execute = (c for c in spec.callbacks if (c.key is not None and not c.builtin))
    assert server.key == Unknown('rclpy does not keep the name of an action server')
    assert (execute.function_name, execute.groupless) == ('execute', True)


def test_process_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match='there is no process 4194305'):
        attach_process(4194305, tmp_path / 'attached.yaml', io.StringIO())


@needs_a_way_in
def test_process_that_is_no_python_is_left_alone(tmp_path: Path) -> None:
    with subprocess.Popen(['sleep', '60']) as other:
        try:
            with pytest.raises(ToolNotFoundError, match=f'process {other.pid} cannot be entered'):
                attach_process(other.pid, tmp_path / 'attached.yaml', io.StringIO())
            with pytest.raises(subprocess.TimeoutExpired):
                other.wait(1)
        finally:
            other.kill()


MANY_WANT_THE_LOCK = """
import threading, time
def work():
    while True:
        sum(range(100_000))
threading.Thread(target=time.sleep, args=(600,), daemon=True).start()
for _ in range(3):
    threading.Thread(target=work, daemon=True).start()
print(flush=True)
work()
"""
ENTRIES = 60


@needs_a_way_in
def test_process_whose_threads_wait_for_the_interpreter_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Entered in such a thread, it would stand for good, and soon."""
    monkeypatch.setattr(injection, 'PATIENCE_S', 20.0)  # the machine may be busy
    script, heard = tmp_path / 'hear.py', tmp_path / 'heard'
    script.write_text(f"open({str(heard)!r}, 'a').write('.')\n")
    command = [sys.executable, '-c', MANY_WANT_THE_LOCK]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as other:
        try:
            assert other.stdout is not None
            other.stdout.readline()
            for _ in range(ENTRIES):
                inject(other.pid, script, injectors())
            wait_until(lambda: len(heard.read_text()) == ENTRIES)
        finally:
            other.kill()
    assert heard.read_text() == ENTRIES * '.'


@needs_a_way_in
def test_process_that_is_hard_to_enter_goes_on_as_it_was(
    rclpy_python: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It allocates, loads C modules, makes entities and keeps the interpreter in bursts."""
    monkeypatch.setattr(injection, 'PATIENCE_S', 20.0)
    outcome = enter_often(rclpy_python, 10)
    assert (outcome.entered, outcome.refused, outcome.frozen, outcome.left) == (10, [], [], [])
    assert outcome.told == 10 * outcome.told[:1]


KEEPS_THE_LOCK = """
import re, threading, time
threading.Thread(target=time.sleep, args=(600,), daemon=True).start()
print(flush=True)
re.match('(a+)+b', 'a' * LENGTH)
print('done', flush=True)
time.sleep(600)
"""


def stuck_length() -> int:
    """Give the text that keeps the interpreter for some 2 to 4 s; a letter more doubles it."""
    length, begun = 16, time.monotonic()
    while time.monotonic() - begun < 0.1:
        length, begun = length + 1, time.monotonic()
        re.match('(a+)+b', 'a' * length)
    return length + 4


@needs_a_way_in
def test_process_that_keeps_the_interpreter_in_c_is_given_up_in_time_and_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(injection, 'PATIENCE_S', 0.5)
    command = [sys.executable, '-c', KEEPS_THE_LOCK.replace('LENGTH', str(stuck_length()))]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as other:
        try:
            assert other.stdout is not None
            other.stdout.readline()
            time.sleep(0.3)
            begun = time.monotonic()
            with pytest.raises(InputError, match='could not be entered within'):
                attach_process(other.pid, tmp_path / 'attached.yaml', io.StringIO())
            assert time.monotonic() - begun < 4
            # Nobody holds it meanwhile.
            assert tracer_of(other.pid) == 0
            with pytest.raises(InputError, match='could not be entered within'):
                attach_process(other.pid, tmp_path / 'attached.yaml', io.StringIO())
            assert other.stdout.readline() == b'done\n'
            wait_until(lambda: b'enter.so' not in Path(f'/proc/{other.pid}/maps').read_bytes())
        finally:
            other.kill()
