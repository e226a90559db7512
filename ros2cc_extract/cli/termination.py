"""A request to end (SIGTERM, SIGHUP) is heard as a Ctrl-C is: what is known by then is told."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

REQUESTS = (signal.SIGTERM, signal.SIGHUP)


@dataclass
class Termination:
    """
    Whether it was asked for.

    :param number: of the signal, 0 for none.
    """

    number: int = 0

    @property
    def is_asked(self) -> bool:
        """Whether somebody has."""
        return self.number != 0

    @property
    def status(self) -> int:
        """What a shell says of a process that such a signal has ended."""
        return 128 + (self.number or signal.SIGINT)


@contextmanager
def termination_as_interrupt() -> Iterator[Termination]:
    """
    Turn requests to end into SIGINT, which a search knows how to end with.

    Handlers of the user's own, signals that are ignored, and threads that hear none, are left
    alone.
    """
    asked = Termination()
    if threading.current_thread() is not threading.main_thread():
        yield asked
        return

    def hear(number: int, frame: object) -> None:
        asked.number = number
        signal.raise_signal(signal.SIGINT)

    heard = [each for each in REQUESTS if signal.getsignal(each) is signal.SIG_DFL]
    for each in heard:
        signal.signal(each, hear)
    try:
        yield asked
    finally:
        for each in heard:
            signal.signal(each, signal.SIG_DFL)
