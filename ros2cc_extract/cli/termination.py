"""A request to end (SIGTERM) is heard as a Ctrl-C is: what is known by then is told."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass


@dataclass
class Termination:
    """Whether it was asked for."""

    is_asked: bool = False


@contextmanager
def termination_as_interrupt() -> Iterator[Termination]:
    """
    Turn SIGTERM into SIGINT, which a search knows how to end with.

    A handler of the user's own, and threads that hear no signals, are left alone.
    """
    asked = Termination()
    is_heard = threading.current_thread() is threading.main_thread()
    if not is_heard or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield asked
        return

    def hear(number: int, frame: object) -> None:
        asked.is_asked = True
        signal.raise_signal(signal.SIGINT)

    signal.signal(signal.SIGTERM, hear)
    try:
        yield asked
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
