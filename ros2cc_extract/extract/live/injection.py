"""
The way into a running process, and which user it lets in.

By what the interpreter offers (Python 3.14, ``sys.remote_exec``), and where that is missing or
refused, as it is by a process of another Python version, by our own library, which the injector
of the extra ``attach`` has loaded (``ptrace_entry.py``). The former runs a few lines in the main
thread, the latter in one of its own.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Container, Iterator, Sequence
from pathlib import Path

from ros2cc_extract.errors import InputError, ToolNotFoundError
from ros2cc_extract.extract.live import ptrace_entry
from ros2cc_extract.file_ownership import open_to_others, user_of_process
from ros2cc_extract.light_dataclasses import dataclass

# A process that runs Python lets us in within milliseconds: the lock of the interpreter is asked
# for, and given up every 5 ms (`sys.getswitchinterval`).
PATIENCE_S = 1.5
_EXTRA = 'pip install "pyinjector>=1.3"'
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
    The user that may read the script: ourselves, or the one we were asked to serve.

    :raises InputError: if that is another user without a request for it.
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
    Make a folder that no other user can enter, or put another in the place of.

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
    found = tuple(each for each in (_remote_exec(), _by_ptrace()) if each is not None)
    if not found and ptrace_entry.library() is None:
        raise ToolNotFoundError(
            'attaching needs Python 3.14 or the native part _enter, which is not built here',
            None,
            'install a wheel for this Python, or a C compiler and this package again '
            '(docs/install.md)',
        )
    if not found:
        raise ToolNotFoundError(
            'attaching needs Python 3.14 or pyinjector', None, f'install it with: {_EXTRA}'
        )
    return found


def _remote_exec() -> Injector | None:
    remote = getattr(sys, 'remote_exec', None)
    if remote is None:
        return None
    return Injector(
        'sys.remote_exec', lambda pid, script: remote(pid, str(script)), (OSError, RuntimeError)
    )


def _by_ptrace() -> Injector | None:
    if not ptrace_entry.is_available():
        return None

    def enter(pid: int, script: Path) -> None:
        with private_folder() as folder:
            ptrace_entry.enter(pid, script, folder, PATIENCE_S)

    return Injector('pyinjector', enter, (OSError,))


def inject(pid: int, script: Path, ways: Sequence[Injector]) -> None:
    """
    Run a script in a process by the first of ``ways`` that is let in.

    :raises ToolNotFoundError: if none is; the message has the answer to each.
    """
    refused: dict[str, Exception] = {}
    for injector in ways:
        try:
            injector.inject(pid, script)
        except injector.refusals as error:
            refused[injector.name] = error
        else:
            return
    # Some messages are whole pages.
    words = '; '.join(f'{name}: {" ".join(str(e).split())[:200]}' for name, e in refused.items())
    raise ToolNotFoundError(f'process {pid} cannot be entered: {words}', None, _mend(refused))


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
    if 'pyinjector' not in refused:
        return f'a process of another Python version needs pyinjector: {_EXTRA}'
    return 'it must be a Python process of yours with a shared libpython, outside containers'
