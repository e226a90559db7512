"""One limit on time for much work: work that can looks at the clock itself, the rest is ended."""

from __future__ import annotations

import gc
import math
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from ros2cc_extract.light_dataclasses import dataclass

GRACE_S = 2.0
"""Time for code that looks at the clock to report what is done."""
_SOON_S = 0.01


@dataclass(frozen=True)
class Deadline:
    """
    When several searches together have to end.

    It travels to another machine as the seconds that are left.

    :param at: by ``time.monotonic``.
    :param reason: to give up then.
    """

    at: float
    reason: str

    @property
    def is_over(self) -> bool:
        """Whether nothing more is to begin."""
        return time.monotonic() > self.at

    def __reduce__(self) -> tuple[Callable[[float, str], Deadline], tuple[float, str]]:
        return _deadline_after, (self.at - time.monotonic(), self.reason)


@dataclass(frozen=True)
class Patience:
    """
    When to end before all is done.

    :param deadline: what is not done by then is reported.
    :param keeps_interrupted: an interrupt ends it, and what is done is reported; else nothing is.
    """

    deadline: Deadline | None = None
    keeps_interrupted: bool = False


PATIENT = Patience()


def deadline_in(seconds: float, of: float) -> Deadline:
    """Give the moment so many seconds from now, which are left ``of`` so many."""
    reason = f'the limit of {of:g} s for all units was reached; see --max-seconds'
    return Deadline(time.monotonic() + seconds, reason)


def _deadline_after(seconds: float, reason: str) -> Deadline:
    return Deadline(time.monotonic() + seconds, reason)


class TimeOverError(BaseException):
    """No ``Exception``, which the code that is ended might take for one of its own."""


@contextmanager
def alarm(seconds: float | None, again_s: float) -> Iterator[Callable[[], None] | None]:
    """
    End what still runs after ``seconds``, wherever it is.

    Gives what takes the alarm back, or ``None`` where none was set: without a limit, in threads
    that hear no signals, where there are alarms of other code, and where the system has none,
    as in a browser. Work that looks at the clock itself ends in time there too.

    :param again_s: what is raised while an object is taken apart is lost, so it rings again
        after so long; and soon where the garbage collector runs a callback.
    :raises TimeOverError: then.
    """
    is_heard = threading.current_thread() is threading.main_thread()
    is_there = is_heard and hasattr(signal, 'setitimer')
    is_free = is_there and signal.getsignal(signal.SIGALRM) is signal.SIG_DFL
    if seconds is None or seconds == math.inf or not is_free:
        yield None
        return

    def hear(number: int, frame: FrameType | None) -> None:
        if not _is_collecting(frame):
            raise TimeOverError
        signal.setitimer(signal.ITIMER_REAL, _SOON_S, again_s)

    signal.signal(signal.SIGALRM, hear)
    signal.setitimer(signal.ITIMER_REAL, max(seconds, 0.001), again_s)
    try:
        yield _disarm
    finally:
        _disarm()
        signal.signal(signal.SIGALRM, signal.SIG_DFL)


def _is_collecting(frame: FrameType | None) -> bool:
    """Whether a callback of the garbage collector runs, which loses what is raised in it."""
    codes = [getattr(callback, '__code__', None) for callback in gc.callbacks]
    while frame is not None:
        if frame.f_code in codes:
            return True
        frame = frame.f_back
    return False


def _disarm() -> None:
    signal.setitimer(signal.ITIMER_REAL, 0)


@contextmanager
def ended_by(deadline: Deadline | None) -> Iterator[None]:
    """
    End what still runs some time after ``deadline``, wherever it is; see ``alarm``.

    :raises TimeOverError: then.
    """
    left = None if deadline is None else max(0.0, deadline.at - time.monotonic()) + GRACE_S
    with alarm(left, GRACE_S):
        yield
