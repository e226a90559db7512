"""
Runs a command as if we were not there: same terminal, same signals, same end.

Linux: signals are taken by ``sigwaitinfo``, which distinguishes a signal sent to us alone from one
that the terminal has sent to the whole foreground group, our child included.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager

from ros2cc_extract.errors import ToolNotFoundError

# What others may send us instead of the command; stopping and continuing act on both anyway.
_PASSED_ON = (
    signal.SIGINT,
    signal.SIGTERM,
    signal.SIGHUP,
    signal.SIGQUIT,
    signal.SIGUSR1,
    signal.SIGUSR2,
    signal.SIGALRM,
    signal.SIGWINCH,
)
_WATCHED = {*_PASSED_ON, signal.SIGCHLD}


def run_child(command: Sequence[str], environment: Mapping[str, str]) -> int:
    """
    Run a command to its end.

    :return: its exit status; the negative signal number if a signal ended it.
    :raises ToolNotFoundError: when it cannot be started.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _WATCHED)
    try:
        child = subprocess.Popen(
            command,
            env=environment,
            preexec_fn=lambda: signal.pthread_sigmask(signal.SIG_SETMASK, before),
        )
    except OSError as error:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        raise ToolNotFoundError(
            f'{command[0]!r} cannot be started: {error.strerror}',
            None,
            'give the command after --, as you would type it without us',
        ) from error
    try:
        return _wait(child)
    finally:
        # A second Ctrl-C may have come while the command was ending: what it held is written.
        _restore(before, _PASSED_ON)


@contextmanager
def deaf_to_ctrl_c() -> Iterator[None]:
    """Finish something short, even if the user presses Ctrl-C once more meanwhile."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        _restore(before, (signal.SIGINT,))


def _restore(mask: Collection[int], dropped: Collection[int]) -> None:
    """Let signals through again, but for those that wait to be."""
    while signal.sigtimedwait(dropped, 0) is not None:
        pass
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)


def _wait(child: subprocess.Popen[bytes]) -> int:
    while child.poll() is None:
        arrived = signal.sigwaitinfo(_WATCHED)
        # Kernel-made signals have a positive code: the terminal has sent them to the child too.
        if arrived.si_signo in _PASSED_ON and arrived.si_code <= 0:
            child.send_signal(arrived.si_signo)
    return child.returncode


def end_alike(status: int) -> int:
    """Give ``status`` back, or end this process by the signal that ended the command."""
    if status >= 0:
        return status
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    # Signals that cannot be caught keep their actions, and cannot be set.
    if -status not in (signal.SIGKILL, signal.SIGSTOP):
        signal.signal(-status, signal.SIG_DFL)
    os.kill(os.getpid(), -status)
    return 128 - status
