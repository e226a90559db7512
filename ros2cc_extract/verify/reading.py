"""A limit on time that covers reading: models and queries of somebody else may be large."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2cc_extract.checker.api import Limits
from ros2cc_extract.checker.limits import seconds_reason
from ros2cc_extract.errors import InputError
from ros2cc_extract.places import Place

_AGAIN_S = 1.0
"""What an alarm raises inside a callback of the garbage collector is lost: it rings again."""


class _TimeOverError(BaseException):
    """No ``Exception``, which a parser might take for one of its own."""


@contextmanager
def limited_reading(limits: Limits, path: Path) -> Iterator[Callable[[], None]]:
    """
    End the reading of a file where the time is over.

    What is given is called once the search has begun, which looks at the clock itself. Threads
    that hear no signals, and alarms of the user's own, are left alone.

    :raises InputError: when the time was over before.
    """
    seconds = limits.seconds_left
    is_heard = threading.current_thread() is threading.main_thread()
    if seconds is None or not is_heard or signal.getsignal(signal.SIGALRM) is not signal.SIG_DFL:
        yield _nothing
        return

    def hear(number: int, frame: object) -> None:
        raise _TimeOverError

    signal.signal(signal.SIGALRM, hear)
    signal.setitimer(signal.ITIMER_REAL, max(seconds, 0.001), _AGAIN_S)
    try:
        yield _disarm
    except _TimeOverError:
        reason = limits.deadline.reason if limits.deadline else seconds_reason(seconds)
        raise InputError(
            f'{reason} before all was read', Place(str(path)), 'give more time by --timeout'
        ) from None
    finally:
        _disarm()
        signal.signal(signal.SIGALRM, signal.SIG_DFL)


def _disarm() -> None:
    signal.setitimer(signal.ITIMER_REAL, 0)


def _nothing() -> None:
    """Nobody waits for it."""
