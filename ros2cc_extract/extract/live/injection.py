"""
The way into a running process, and whom it lets in.

By what the interpreter offers (Python 3.14, ``sys.remote_exec``), and where that is missing or
refused, as it is by a process of another Python version, by hypno, the injector of the extra
``attach``. Either runs a few lines in one of the process's threads.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import select
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.file_ownership import open_to_others, user_of_process

# A process that runs Python lets us in within milliseconds: the lock of the interpreter is asked
# for, and given up every 5 ms (`sys.getswitchinterval`).
PATIENCE_S = 1.5
MOST_TOLD_BYTES = 2000
_QUIET_S = 0.03
_EXTRA = 'pip install "hypno>=1.1"'
_PTRACE_SCOPE = Path('/proc/sys/kernel/yama/ptrace_scope')


@dataclass(frozen=True)
class Injector:
    """
    Runs a script in another process.

    :param name: what it is called in messages.
    :param refusals: what ``inject`` raises when the process cannot be entered.
    """

    name: str
    inject: Callable[[int, Path], None]
    refusals: tuple[type[Exception], ...]


def check_process(pid: int) -> None:
    if pid <= 0:
        raise InputError(f'{pid} is no process number')
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        raise InputError(f'there is no process {pid}') from None
    except PermissionError:
        raise InputError(
            f'process {pid} belongs to another user', None, 'run as its user or as root'
        ) from None
    except OverflowError:
        raise InputError(f'{pid} is no process number') from None


def user_to_enter(pid: int, *, other_user: bool) -> int:
    """
    Who gets to read the script: ourselves, or whom we were asked to serve.

    :raises InputError: when that is another user and nobody asked for it.
    """
    try:
        user = user_of_process(pid)
    except OSError:
        raise InputError(f'there is no process {pid}') from None
    if user is None:
        raise InputError(f'process {pid} changes between users, and is not entered')
    if user != os.geteuid() and not other_user:
        raise InputError(
            f'process {pid} belongs to user {user}, and you are user {os.geteuid()}',
            None,
            f'run as that user, or add --other-user: what user {user} can make of the answer is '
            'then read by you',
        )
    return user


@contextlib.contextmanager
def private_folder() -> Iterator[Path]:
    """
    Make a folder that nobody else can enter, or put another in the place of.

    :raises InputError: when the folder for temporary files lets others do so.
    """
    parent = Path(tempfile.gettempdir())
    replaceable = open_to_others(parent)
    if replaceable is not None:
        raise InputError(
            f'{replaceable} lets other users replace what is handed to the process',
            None,
            'set TMPDIR to a folder of your own',
        )
    folder = tempfile.mkdtemp(prefix='ros2cc-attach-', dir=parent)
    try:
        yield Path(folder)
    finally:
        # Not by TemporaryDirectory, which may change modes behind links (CVE-2023-6597).
        shutil.rmtree(folder, ignore_errors=True)


def injectors() -> tuple[Injector, ...]:
    """Give what there is, in the order in which it is to be tried."""
    found = tuple(each for each in (_remote_exec(), _hypno()) if each is not None)
    if not found:
        raise ToolNotFoundError(
            'attaching needs Python 3.14 or the injector hypno', None, f'install it with: {_EXTRA}'
        )
    return found


def _remote_exec() -> Injector | None:
    remote = getattr(sys, 'remote_exec', None)
    if remote is None:
        return None
    return Injector(
        'sys.remote_exec', lambda pid, script: remote(pid, str(script)), (OSError, RuntimeError)
    )


def _hypno() -> Injector | None:
    try:
        hypno = importlib.import_module('hypno')
        refusals = (OSError, importlib.import_module('pyinjector').PyInjectorError)
    except ImportError:
        return None

    def inject(pid: int, script: Path) -> None:
        refuse_what_would_end(pid)
        refuse_what_is_traced(pid)
        # Who was given up is let in late: by then the script may have been taken away.
        path = repr(str(script))
        lines = f'import os\nif os.path.exists({path}): exec(open({path}).read(), {{}})'
        thread = thread_to_enter(pid)
        in_time(lambda: hypno.inject_py(thread, lines), pid, refusals)

    return Injector('hypno', inject, refusals)


def refuse_what_would_end(pid: int) -> None:
    """
    Look whether a process has what an injected library calls: without it, the linker ends it.

    :raises OSError: when it has not, or cannot be looked at.
    """
    program = Path(f'/proc/{pid}/exe')
    names = program.read_bytes()
    is_shared = b'libpython' in names and 'libpython' in Path(f'/proc/{pid}/maps').read_text()
    if not is_shared and b'PyGILState_Ensure' not in names:
        raise OSError(f'{program.resolve().name} is no Python interpreter that lets others in')


def refuse_what_is_traced(pid: int) -> None:
    """
    Look whether somebody else has stopped a thread of the process, or is about to.

    :raises InputError: then; a debugger, or one of us who was not let in.
    """
    for thread in Path(f'/proc/{pid}/task').iterdir():
        fields = _status(thread)
        tracer = int(fields.get('TracerPid', '0'))
        if tracer:
            raise InputError(
                f'process {pid} is traced by process {tracer}: a debugger, or an attempt to enter '
                'it that is not over'
            )


def thread_to_enter(pid: int) -> int:
    """
    Choose the thread that is to run the lines: one that has slept for a while, and does so most.

    It is stopped where it stands. One that runs may just hold a lock of the C library, which the
    injected call needs too. One that waits for the lock of the interpreter is worse: who gives
    that lock away waits until it has left the condition variable, and it is kept by our call,
    which needs the lock (glibc, ``__condvar_quiesce_and_switch_g1``): both wait forever. It looks
    again every 5 ms (CPython, ``take_gil``), so a thread that was not once at work for longer is
    not such a one. Those of the middleware, which run no Python, sleep most.

    :raises InputError: when none sleeps for long.
    """
    given_up = time.monotonic() + PATIENCE_S
    while time.monotonic() < given_up:
        threads = [int(each.name) for each in Path(f'/proc/{pid}/task').iterdir()]
        if len(threads) == 1:
            return pid
        before = {each: _switches(pid, each) for each in threads}
        time.sleep(_QUIET_S)
        quiet = [
            (switches, each)
            for each, switches in before.items()
            if switches is not None and _switches(pid, each) == switches
        ]
        if quiet:
            return min(quiet)[1]
    raise InputError(
        f'process {pid} has no thread that sleeps for {_QUIET_S:g} s: entered in another one, it '
        'could stop for good',
        None,
        'try again',
    )


def _switches(pid: int, thread: int) -> int | None:
    """How often a thread was at work so far; ``None`` where it is now."""
    fields = _status(Path(f'/proc/{pid}/task/{thread}'))
    if not fields.get('State', '').startswith('S'):
        return None
    return int(fields['voluntary_ctxt_switches']) + int(fields['nonvoluntary_ctxt_switches'])


def _status(thread: Path) -> dict[str, str]:
    """What the system says of a thread (proc(5), status); nothing where it has ended."""
    try:
        lines = (thread / 'status').read_text(errors='replace').splitlines()
    except OSError:
        return {}
    return {name: value.strip() for name, _, value in (line.partition(':') for line in lines)}


def in_time(enter: Callable[[], None], pid: int, refusals: tuple[type[Exception], ...]) -> None:
    """
    Run what enters a process in a child, which is not waited for longer than ``PATIENCE_S``.

    Neither that time nor Ctrl-C may end the child: it holds a thread of the process in the middle
    of a call that is not its own, and whoever lets go of it there ends the process. So it stays
    until the process gives it the interpreter, and nobody waits.

    :raises OSError: with what a refusal says.
    :raises InputError: when the time is over.
    """
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        _enter_alone(enter, write, refusals)
    os.close(write)
    with os.fdopen(read, 'rb') as answer:
        ready, _, _ = select.select([answer], [], [], PATIENCE_S)
        if not ready:
            raise InputError(
                f'process {pid} could not be entered within {PATIENCE_S:g} s: it runs C code '
                'that keeps the lock of the interpreter, or is stopped',
                None,
                'none of its Python threads can run meanwhile; a debugger of C shows where it is',
            )
        told = answer.read(MOST_TOLD_BYTES)
    os.waitpid(child, 0)
    if told != _DONE:
        raise OSError(told.decode(errors='replace') or 'the injector ended without an answer')


_DONE = b'in'


def _enter_alone(
    enter: Callable[[], None], write: int, refusals: tuple[type[Exception], ...]
) -> None:
    """Be the child; never returns."""
    try:
        os.setsid()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        # Who reads our output must not wait for a child that stays.
        nothing = os.open(os.devnull, os.O_RDWR)
        for stream in range(3):
            os.dup2(nothing, stream)
        enter()
        os.write(write, _DONE)
    except refusals as error:
        os.write(write, ' '.join(str(error).split())[:MOST_TOLD_BYTES].encode())
    except BaseException as error:
        os.write(write, repr(error)[:MOST_TOLD_BYTES].encode())
    finally:
        os._exit(0)


def inject(pid: int, script: Path, ways: Sequence[Injector]) -> None:
    """
    Run a script in a process by the first of ``ways`` that is let in.

    :raises ToolNotFoundError: when none is; says what each was told.
    """
    refused: dict[str, Exception] = {}
    for injector in ways:
        try:
            injector.inject(pid, script)
        except injector.refusals as error:
            refused[injector.name] = error
        else:
            return
    # Some tell whole pages.
    told = '; '.join(f'{name}: {" ".join(str(e).split())[:200]}' for name, e in refused.items())
    raise ToolNotFoundError(f'process {pid} cannot be entered: {told}', None, _mend(refused))


def _mend(refused: Container[str]) -> str:
    try:
        scope = _PTRACE_SCOPE.read_text().strip()
    except OSError:
        scope = '0'
    if scope != '0' and os.geteuid() != 0:
        return (
            f'the system forbids it ({_PTRACE_SCOPE} is {scope}); run as root, or ask for '
            'sysctl kernel.yama.ptrace_scope=0'
        )
    if 'hypno' not in refused:
        return f'a process of another Python version needs the injector hypno: {_EXTRA}'
    return 'it must be a Python process of yours with a shared libpython, outside containers'
