"""
``attach``: the specification of a process that already runs, without having started it.

By what the interpreter offers (Python 3.14, ``sys.remote_exec``), and where that is missing or
refused, as it is by a process of another Python version, by hypno, the injector of the extra
``attach``. Either runs a few lines in the process's main thread, which write a recording and leave
nothing behind.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Container, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live.collect import specs_of
from ros2cc_extract.extract.live.recording import read_recording
from ros2cc_extract.extract.live.run import check_file, report_losses, write_specs_to
from ros2cc_extract.files import read_regular
from ros2cc_extract.trust import open_to_others, user_of_process

EXIT_CLEAN, EXIT_ERROR = 0, 2
# The main thread runs our lines as soon as it is back from C; an executor wakes at every event.
PATIENCE_S = 15.0
MOST_TOLD_BYTES = 10_000
_LOOK_EVERY_S = 0.05
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


_LINES = """
import importlib, importlib.util, os, sys
def _record(name='_ros2cc_attached'):
    folder, path = {folder!r}, {path!r}
    try:
        spec = importlib.util.spec_from_file_location(
            name, os.path.join(folder, '__init__.py'), submodule_search_locations=[folder])
        sys.modules[name] = importlib.util.module_from_spec(spec)
        importlib.import_module(name + '.hook.inspection').record_process(path + '.new')
        os.replace(path + '.new', path)
    except Exception as error:
        with open(path + '.failed', 'w') as stream:
            stream.write(repr(error))
    finally:
        for loaded in [each for each in sys.modules if each.partition('.')[0] == name]:
            del sys.modules[loaded]
_record()
del _record
"""


def attach_process(pid: int, output: Path, stderr: TextIO, *, other_user: bool = False) -> int:
    """
    Write the specification of a running process.

    :param other_user: enter a process of another user too, which root may.
    :return: 0; 2 when the process holds no node in an rclpy executor.
    :raises InputError: when there is no such process, it is another user's, or does not answer.
    :raises ToolNotFoundError: when nothing here can run code in it.
    """
    check_file(output)
    _check_process(pid)
    user = _user_to_enter(pid, other_user=other_user)
    ways = injectors()
    with private_folder() as folder:
        recording = read_recording(_record(pid, user, folder, ways), Path.cwd())
    report_losses([recording], stderr)
    specs = specs_of(recording)
    if not specs:
        print(f'ros2cc-extract: process {pid} has no node in an rclpy executor', file=stderr)
        return EXIT_ERROR
    write_specs_to(output, specs)
    return EXIT_CLEAN


def _check_process(pid: int) -> None:
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


def _user_to_enter(pid: int, *, other_user: bool) -> int:
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
        hypno.inject_py(pid, f'exec(open({str(script)!r}).read(), {{}})')

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


def _record(pid: int, user: int, folder: Path, ways: Sequence[Injector]) -> Path:
    recording = folder / f'{pid}.json'
    script = folder / 'record.py'
    package = str(Path(__file__).resolve().parent)
    script.write_text(_LINES.format(folder=package, path=str(recording)), encoding='utf-8')
    if user != os.geteuid():
        # From here on it is theirs: they may write there, and nothing there is followed by us.
        script.chmod(0o644)
        os.chown(folder, user, -1)
    inject(pid, script, ways)
    return _await(recording, pid)


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


def _await(recording: Path, pid: int) -> Path:
    failure = recording.with_name(f'{recording.name}.failed')
    deadline = time.monotonic() + PATIENCE_S
    while not recording.exists():
        if failure.exists():
            raise InputError(f'process {pid} could not be recorded: {_told_by(failure)}')
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} does not answer: its main thread runs no Python',
                None,
                'it is blocked in C, or no Python process',
            )
        time.sleep(_LOOK_EVERY_S)
    return recording


def _told_by(failure: Path) -> str:
    try:
        return ascii(read_regular(failure, MOST_TOLD_BYTES, follow=False).decode(errors='replace'))
    except OSError as error:
        return f'{error.strerror}'


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
