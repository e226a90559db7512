"""
The thread of a process that may be stopped and lent for a call that is not its own.

The call takes the locks of the dynamic linker and of malloc. A thread that was stopped while it
held one of them, or while another thread waits for it to leave a condition variable, would wait
for itself, and the process would stand for good. A thread that sleeps in a system call by which
it waits for the network, a child, a signal or time holds none of them: neither the linker nor
malloc makes such a call. A futex may be any lock, the interpreter's included, so no thread
that waits for one is chosen.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from ros2cc_extract.errors import InputError

# Numbers on x86-64 and aarch64, by Linux: arch/x86/entry/syscalls/syscall_64.tbl, and
# scripts/syscall.tbl. The sooner the better: receiving is resumed as if nothing had been, while
# epoll_wait fails (EINTR, signal(7)).
_CALLS: Mapping[str, tuple[int | None, int | None]] = {
    'recvfrom': (45, 207),
    'recvmsg': (47, 212),
    'recvmmsg': (299, 243),
    'accept': (43, 202),
    'accept4': (288, 242),
    'poll': (7, None),
    'ppoll': (271, 73),
    'select': (23, None),
    'pselect6': (270, 72),
    'wait4': (61, 260),
    'waitid': (247, 95),
    'pause': (34, None),
    'rt_sigsuspend': (130, 133),
    'rt_sigtimedwait': (128, 137),
    'nanosleep': (35, 101),
    'clock_nanosleep': (230, 115),
    'epoll_wait': (232, None),
    'epoll_pwait': (281, 22),
    'epoll_pwait2': (441, 441),
}
_IS_AARCH64 = os.uname().machine == 'aarch64'
_RANKS: Mapping[int | None, int] = {
    numbers[_IS_AARCH64]: rank for rank, numbers in enumerate(_CALLS.values())
}


def threads_to_enter(pid: int) -> list[int]:
    """
    Give the threads that sleep in a system call of their own now, the best one first.

    What is sent to the process, as Ctrl-C is, goes to its main thread: that one is the last.

    :raises InputError: when the process is stopped: it would not go on when it is let go.
    """
    ranked = []
    states = set()
    for task in _tasks(pid):
        thread = int(task.name)
        state = state_of(pid, thread)
        states.add(state)
        rank = _rank(task) if state == 'S' else None
        if rank is not None:
            ranked.append((thread == pid, rank, thread))
    if states == {'T'}:
        raise InputError(f'process {pid} is stopped', None, f'let it go on: kill -CONT {pid}')
    return [thread for _, _, thread in sorted(ranked)]


def sleeps_in_a_call_of_its_own(pid: int, thread: int) -> bool:
    """
    Return whether a thread may be lent. Asked again when it is stopped: it may have woken before.

    One that was stopped as it came back from the call stands behind it, and nowhere else.
    """
    return _rank(Path(f'/proc/{pid}/task/{thread}')) is not None


def state_of(pid: int, thread: int) -> str:
    """Give the letter of proc(5), ``S`` for one that sleeps; empty where it has ended."""
    return _status(Path(f'/proc/{pid}/task/{thread}')).get('State', '')[:1]


def tracer_of(pid: int) -> int:
    """Give the process that traces one of the threads, a debugger for example, or 0."""
    tracers = (int(_status(task).get('TracerPid', '0')) for task in _tasks(pid))
    return next((tracer for tracer in tracers if tracer), 0)


def _rank(task: Path) -> int | None:
    """
    Where its system call stands in the table (proc(5), syscall); nothing if not there.

    :raises PermissionError: when the system does not let us look, and so would not let us in.
    """
    try:
        number = (task / 'syscall').read_text().partition(' ')[0]
    except (FileNotFoundError, ProcessLookupError):
        return None
    return _RANKS.get(int(number)) if number.lstrip('-').isdecimal() else None


def _tasks(pid: int) -> list[Path]:
    try:
        return list(Path(f'/proc/{pid}/task').iterdir())
    except OSError:
        return []


def _status(task: Path) -> dict[str, str]:
    """What the system says of a thread (proc(5), status); nothing where it has ended."""
    try:
        lines = (task / 'status').read_text(errors='replace').splitlines()
    except OSError:
        return {}
    return {name: value.strip() for name, _, value in (line.partition(':') for line in lines)}
