"""Handle a request to end (SIGTERM, SIGHUP) as a Ctrl-C: what is known by then is reported."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from ros2cc_extract.light_dataclasses import dataclass

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
        """Whether the end was requested."""
        return self.number != 0

    @property
    def status(self) -> int:
        """What a shell says of a process that such a signal has ended."""
        return 128 + (self.number or signal.SIGINT)


@contextmanager
def termination_as_interrupt(asked: Termination) -> Iterator[None]:
    """
    Turn requests to end into SIGINT, which a search knows how to end with.

    The interrupt may come at the end of the context too: it is caught outside. Handlers of the
    user's own, signals that are ignored, and threads that hear none, are left alone.

    :param asked: called with the signal that was received.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def hear(number: int, frame: object) -> None:
        asked.number = number
        signal.raise_signal(signal.SIGINT)

    heard = [each for each in REQUESTS if signal.getsignal(each) is signal.SIG_DFL]
    for each in heard:
        signal.signal(each, hear)
    try:
        yield
    finally:
        for each in heard:
            signal.signal(each, signal.SIG_DFL)


def forget_interrupt() -> None:
    """
    Let the process end with its own status, though an interrupt was caught on the way.

    An interrupt that leaves ``exec`` of a text (each data class is made by one) is noted by
    CPython as uncaught, even if it is caught: ``python -m`` then ends by SIGINT, with
    any status (``unhandled_keyboard_interrupt`` in Python/pythonrun.c and
    Modules/main.c). The next text that is run takes the note back.
    """
    exec('')
