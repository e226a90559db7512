"""
``attach``: the specification of a process that already runs, without having started it.

By what the interpreter offers (Python 3.14, ``sys.remote_exec``), and where that is missing or
refused, as it is by a process of another Python version, by hypno, the injector of the extra
``attach``. Either runs a few lines in the process's main thread, which write a recording and leave
nothing behind.
"""

from __future__ import annotations

import importlib
import os
import sys
import tempfile
import time
from collections.abc import Callable, Container, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live.collect import specs_of
from ros2cc_extract.extract.live.recording import read_recording
from ros2cc_extract.extract.live.run import check_file, report_losses, write_specs_to

EXIT_CLEAN, EXIT_ERROR = 0, 2
# The main thread runs our lines as soon as it is back from C; an executor wakes at every event.
PATIENCE_S = 15.0
_LOOK_EVERY_S = 0.05
_EXTRA = 'pip install "ros2cc-extract[attach]"'
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
        importlib.import_module(name + '.inspection').record_process(path + '.new')
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


def attach_process(pid: int, output: Path, stderr: TextIO) -> int:
    """
    Write the specification of a running process.

    :return: 0; 2 when the process holds no node in an rclpy executor.
    :raises InputError: when there is no such process, or it does not answer.
    :raises ToolNotFoundError: when nothing here can run code in it.
    """
    check_file(output)
    _check_process(pid)
    ways = injectors()
    with tempfile.TemporaryDirectory(prefix='ros2cc-attach-') as directory:
        # The process may belong to another user.
        Path(directory).chmod(0o777)
        recording = read_recording(_record(pid, Path(directory), ways), Path.cwd())
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


def _record(pid: int, directory: Path, ways: Sequence[Injector]) -> Path:
    recording = directory / f'{pid}.json'
    script = directory / 'record.py'
    folder = str(Path(__file__).resolve().parent)
    script.write_text(_LINES.format(folder=folder, path=str(recording)), encoding='utf-8')
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
            raise InputError(f'process {pid} could not be recorded: {failure.read_text()}')
        if time.monotonic() > deadline:
            raise InputError(
                f'process {pid} does not answer: its main thread runs no Python',
                None,
                'it is blocked in C, or no Python process',
            )
        time.sleep(_LOOK_EVERY_S)
    return recording


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
