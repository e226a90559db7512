"""Ctrl-C during a search: noted, so that the search can end with what it knows."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def noted(note: Callable[[], None]) -> Iterator[None]:
    """
    Call ``note`` for a Ctrl-C instead of raising ``KeyboardInterrupt``.

    Python raises it wherever it is just then, also where a call from the core has not yet come to
    its own ``try``. A handler of the user's own, and threads that hear no signals, are left alone.
    """
    is_heard = threading.current_thread() is threading.main_thread()
    if not is_heard or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, lambda number, frame: note())
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
