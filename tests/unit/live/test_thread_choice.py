"""Only a thread that sleeps in its own system call is stopped; a stopped process is reported."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live import injection
from ros2cc_extract.extract.live.injection import inject, injectors
from ros2cc_extract.extract.live.ptrace_entry import is_available
from ros2cc_extract.extract.live.thread_choice import (
    sleeps_in_a_call_of_its_own,
    state_of,
    threads_to_enter,
)

THREADS = """
import os, select, socket, threading, time
ones = socket.socketpair()
def tell(name):
    os.write(1, f'{{name}} {{threading.get_native_id()}}\\n'.encode())
def work():
    while True:
        sum(range(1000))
def of(call):
    def run():
        tell(call.__name__)
        call()
    threading.Thread(target=run, daemon=True).start()
def receive(): ones[0].recv(1)
def sleep(): time.sleep(600)
def lock():
    mine = threading.Lock()
    mine.acquire()
    mine.acquire()
def wait(): threading.Event().wait()
def read(): os.read(os.pipe()[0], 1)
for call in {calls}:
    of(call)
tell('main')
{main}
"""
ALL = '(sleep, receive, lock, wait, read, work)'
needs_our_way_in = pytest.mark.skipif(not is_available(), reason='no pyinjector, or no _enter')


@pytest.fixture
def start() -> Iterator[Callable[..., dict[str, int]]]:
    """Run a program with such threads; give the number of each when they stand."""
    started = []

    def run(calls: str, main: str = 'select.select([ones[1]], [], [])') -> dict[str, int]:
        text = THREADS.format(calls=calls, main=main)
        process = subprocess.Popen([sys.executable, '-c', text], stdout=subprocess.PIPE, text=True)
        started.append(process)
        assert process.stdout is not None
        found = {}
        while len(found) < calls.count(',') + 2:  # the main thread as well
            name, number = process.stdout.readline().split()
            found[name] = int(number)
        time.sleep(0.2)
        return found

    yield run
    for process in started:
        process.kill()
        process.wait()


def worked_s(thread: int) -> float:
    """Give how long a thread has worked within a moment."""
    stat = Path(f'/proc/{thread}/schedstat')
    before = int(stat.read_text().split()[0])
    time.sleep(0.5)
    return (int(stat.read_text().split()[0]) - before) / 1e9


def test_who_receives_comes_first_and_the_main_thread_last(
    start: Callable[..., dict[str, int]],
) -> None:
    numbers = start(ALL)
    chosen = [numbers[each] for each in ('receive', 'sleep', 'main')]
    assert threads_to_enter(numbers['main']) == chosen


def test_one_that_waits_for_a_lock_or_works_is_none(start: Callable[..., dict[str, int]]) -> None:
    numbers = start('(lock, wait, work)', 'work()')
    main = numbers['main']
    assert threads_to_enter(main) == []
    assert not any(sleeps_in_a_call_of_its_own(main, each) for each in numbers.values())


@needs_our_way_in
def test_process_without_such_a_thread_is_not_entered_in_time_and_goes_on(
    start: Callable[..., dict[str, int]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(injection, 'PATIENCE_S', 0.3)
    numbers = start('(lock, wait, work)', 'work()')
    script = tmp_path / 'script.py'
    script.write_text(f'open({str(tmp_path / "heard")!r}, "w")')
    ways = [each for each in injectors() if each.name == 'pyinjector']
    begun = time.monotonic()
    with pytest.raises(InputError, match='has no thread that sleeps in a system call of its own'):
        inject(numbers['main'], script, ways)
    assert time.monotonic() - begun < 5.0
    assert worked_s(numbers['work']) > 0.0
    assert not (tmp_path / 'heard').exists()


@needs_our_way_in
def test_stopped_process_is_told_at_once(
    start: Callable[..., dict[str, int]], tmp_path: Path
) -> None:
    main = start(ALL)['main']
    os.kill(main, signal.SIGSTOP)
    time.sleep(0.2)
    ways = [each for each in injectors() if each.name == 'pyinjector']
    (tmp_path / 'script.py').write_text('')
    with pytest.raises(InputError, match=f'process {main} is stopped; let it go on: kill -CONT'):
        inject(main, tmp_path / 'script.py', ways)
    assert state_of(main, main) == 'T'


@needs_our_way_in
def test_script_has_names_of_its_own_and_its_error_is_nobodys(
    start: Callable[..., dict[str, int]], tmp_path: Path
) -> None:
    main = start(ALL)['main']
    script, heard = tmp_path / 'script.py', tmp_path / 'heard'
    ways = [each for each in injectors() if each.name == 'pyinjector']
    for text in (
        'mine = 1; import nowhere',
        'raise SystemExit(3)',
        'this is no Python',
        f'import __main__; names, heard = vars(__main__), open({str(heard)!r}, "w"); '
        'print("mine" in names, "call" in names, sorted(globals()), file=heard, flush=True)',
    ):
        script.write_text(text)
        inject(main, script, ways)
    deadline = time.monotonic() + 20.0
    while not (heard.exists() and heard.read_text()) and time.monotonic() < deadline:
        time.sleep(0.02)
    own = ['__builtins__', '__main__', 'heard', 'names']
    assert heard.read_text() == f'False True {own}\n'
    assert state_of(main, main) == 'S'
