"""
Our own way into a process: a small library that runs a script in a thread of its own.

pyinjector (extra ``attach``) stops one thread of the process, lets it load the library, and lets
it go on as it was. The library (``native/enter.c``) waits for nothing while it is loaded, in
particular not for the lock of the interpreter: a thread that waits for that with the linker's lock
freezes a process that imports a C module at that moment. When the script has ended, the library
is unloaded.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import select
import shutil
import signal
import time
from collections.abc import Callable
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.thread_choice import (
    sleeps_in_a_call_of_its_own,
    state_of,
    threads_to_enter,
    tracer_of,
)

MOST_REPORTED_BYTES = 2000
_LOOK_EVERY_S = 0.002
_IN, _REFUSED, _GIVEN_UP = b'i', b'r', b'g'


def library() -> Path | None:
    """Give the library as it was built, or nothing where it was not."""
    here = Path(__file__).parent
    built = (here / f'_enter{suffix}' for suffix in EXTENSION_SUFFIXES)
    return next((path for path in built if path.is_file()), None)


def is_available() -> bool:
    """Return whether the injector and the library that it loads are there."""
    try:
        importlib.import_module('pyinjector')
    except ImportError:
        return False
    return library() is not None


def enter(pid: int, script: Path, folder: Path, patience_s: float) -> None:
    """
    Start a script in a process; it runs when this returns, or has ended.

    :param folder: empty, and our own. A process that was given up enters late: if the folder has
        been taken away by then, nothing is run.
    :param patience_s: how long to wait for a thread that may be stopped, and for the interpreter.
    :raises OSError: when the process or the system refuses.
    :raises InputError: when it is no time to enter, with the reason.
    """
    refuse_what_would_not_run_it(pid)
    deadline = time.monotonic() + patience_s
    built = library()
    assert built is not None
    # For each entry a file of its own: what is loaded already would not be loaded again.
    entry = folder / 'enter.so'
    shutil.copyfile(built, entry)
    shutil.copyfile(script, entry.with_suffix('.py'))
    user = Path(f'/proc/{pid}').stat().st_uid
    if user != os.geteuid():
        # From here on it is theirs, as that of the answer.
        os.chown(folder, user, -1)
    _in_a_child(lambda: _load(pid, entry, deadline), pid, deadline)
    while not os.path.lexists(entry.with_suffix('.begun')):
        if os.path.lexists(entry.with_suffix('.refused')):
            raise OSError('it can start no thread, or its interpreter is ending')
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} could not be entered within {patience_s:g} s: it runs C code '
                'that keeps the lock of the interpreter',
                None,
                'none of its Python threads can run meanwhile; a debugger of C shows where it is',
            )
        os.kill(pid, 0)
        time.sleep(_LOOK_EVERY_S)


def refuse_what_would_not_run_it(pid: int) -> None:
    """
    Look whether a process has what the library calls.

    :raises OSError: when it has not, or cannot be looked at.
    """
    program = Path(f'/proc/{pid}/exe')
    names = program.read_bytes()
    is_shared = b'libpython' in names and 'libpython' in Path(f'/proc/{pid}/maps').read_text()
    if not is_shared and b'PyGILState_Ensure' not in names:
        raise OSError(f'{program.resolve().name} is no Python interpreter that lets others in')


def _load(pid: int, entry: Path, deadline: float) -> None:
    """
    Let a thread of the process load the library, as soon as there is one that may be stopped.

    :raises InputError: when there is none in time, or a debugger is in the way.
    """
    while True:
        # Another one of us is gone at once; a debugger stays.
        tracer = tracer_of(pid)
        if not tracer and any(_is_loaded_by(t, pid, entry) for t in threads_to_enter(pid)):
            return
        if time.monotonic() > deadline:
            break
        time.sleep(_LOOK_EVERY_S)
    if tracer:
        raise InputError(f'process {pid} is traced by process {tracer}, a debugger for example')
    raise InputError(
        f'process {pid} has no thread that sleeps in a system call of its own: entered in another '
        'one, it could stop for good',
        None,
        'try again',
    )


def _is_loaded_by(thread: int, pid: int, entry: Path) -> bool:
    """Let a thread load the library, unless it has ended, is traced by now, or does other work."""
    pyinjector = importlib.import_module('pyinjector')
    is_loading = False
    try:
        with pyinjector.attach(thread) as stopped:
            is_loading = sleeps_in_a_call_of_its_own(pid, thread)
            if is_loading:
                stopped.inject(os.fsencode(entry))
    except pyinjector.PyInjectorError:
        if is_loading or (state_of(pid, thread) and not tracer_of(pid)):
            raise
    finally:
        _let_go_on(pid, thread)
    return is_loading


def _let_go_on(pid: int, thread: int) -> None:
    """Undo the stop of ptrace(2) where a signal to the process came at the same time."""
    if state_of(pid, thread) == 'T':
        with contextlib.suppress(OSError):
            os.kill(pid, signal.SIGCONT)


def _in_a_child(work: Callable[[], None], pid: int, deadline: float) -> None:
    """
    Do in a child what holds a thread of another process, and wait for it until the deadline.

    Neither that nor Ctrl-C may end the child: it holds the thread in the middle of a call that is
    not its own, and letting go of it there ends the process. So it stays until that call is
    done, and nothing waits for it.

    :raises OSError: with what a refusal says.
    :raises InputError: with the reason why it was given up.
    """
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        _work_alone(work, write)
    os.close(write)
    with os.fdopen(read, 'rb') as answer:
        # Its own time is up a little sooner.
        ready, _, _ = select.select([answer], [], [], max(0.0, deadline - time.monotonic()) + 0.2)
        if not ready:
            raise InputError(
                f'process {pid} does not come to an end of loading a library: another one of its '
                'threads keeps the lock of the dynamic linker'
            )
        reported = answer.read(MOST_REPORTED_BYTES)
    os.waitpid(child, 0)
    what, _, mend = reported[1:].decode(errors='replace').partition('\0')
    if reported[:1] == _GIVEN_UP:
        raise InputError(what, None, mend)
    if reported[:1] != _IN:
        raise OSError(what or 'the injector ended without an answer')


def _work_alone(work: Callable[[], None], write: int) -> None:
    """Be the child; never returns."""
    try:
        os.setsid()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        # The reader of our output must not wait for a child that stays.
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream in range(3):
            os.dup2(nothing, stream)
        work()
        os.write(write, _IN)
    except InputError as error:
        os.write(write, _GIVEN_UP + f'{error.what}\0{error.mend}'.encode()[:MOST_REPORTED_BYTES])
    except BaseException as error:
        reported = ' '.join(str(error).split()) or repr(error)
        os.write(write, _REFUSED + reported[:MOST_REPORTED_BYTES].encode())
    finally:
        os._exit(0)
