"""One limit on time for much work: work that can looks at the clock itself, the rest is ended."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

GRACE_S = 2.0
"""So long whoever looks at the clock may take to tell what is done."""


@dataclass(frozen=True)
class Deadline:
    """
    When several searches together have to end.

    :param at: by ``time.monotonic``.
    :param reason: to give up then.
    """

    at: float
    reason: str

    @property
    def is_over(self) -> bool:
        """Whether nothing more is to begin."""
        return time.monotonic() > self.at


@dataclass(frozen=True)
class Patience:
    """
    When to end before all is done.

    :param deadline: what is not done by then is told.
    :param keeps_interrupted: an interrupt ends it, and what is done is told; else nothing is.
    """

    deadline: Deadline | None = None
    keeps_interrupted: bool = False


PATIENT = Patience()


def deadline_in(seconds: float) -> Deadline:
    """Give the moment so many seconds from now."""
    reason = f'the limit of {seconds:g} s for all units was reached; see --max-seconds'
    return Deadline(time.monotonic() + seconds, reason)


class TimeOverError(BaseException):
    """No ``Exception``, which the code that is ended might take for one of its own."""


@contextmanager
def ended_by(deadline: Deadline | None) -> Iterator[None]:
    """
    End what still runs some time after ``deadline``, wherever it is.

    Threads that hear no signals, and alarms of somebody else, are left alone.

    :raises TimeOverError: then.
    """
    is_heard = threading.current_thread() is threading.main_thread()
    if deadline is None or not is_heard or signal.getsignal(signal.SIGALRM) is not signal.SIG_DFL:
        yield
        return

    def hear(number: int, frame: object) -> None:
        raise TimeOverError

    signal.signal(signal.SIGALRM, hear)
    left = max(0.0, deadline.at - time.monotonic())
    # What is raised inside a callback of the garbage collector is lost: it rings again.
    signal.setitimer(signal.ITIMER_REAL, left + GRACE_S, GRACE_S)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
