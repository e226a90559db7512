"""
The steps of executors that have happened and that the hook's thread has not taken yet.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours. ``native`` is the same in C (``native/journal.c``) with the wrappers that stand on the
way of every callback, where it was built for this interpreter: a step costs a third there, and a
message of a traced program is not reported late. ``ROS2CC_LIVE_NATIVE=0`` does without it.
"""

from __future__ import annotations

import os
import time
from collections import deque
from threading import get_ident
from typing import Any, Protocol

from .events import pack

NATIVE_VARIABLE = 'ROS2CC_LIVE_NATIVE'
# Of what is called in native/journal.c.
_REVISION = 4


class Journal(Protocol):
    """The last steps, at most ``kept`` of them."""

    def note(self, what: int, number: int, /) -> None:
        """Note a step that happens here and now, in this thread."""

    def put(self, clock_ns: int, thread: int, what: int, number: int, /) -> None:
        """Note a step that has happened."""

    def take(self, most: int, /) -> bytes:
        """Give the oldest steps, at most so many, as ``events.py`` reads them, and forget them."""

    def clear(self) -> None: ...

    def __len__(self) -> int: ...


class PlainJournal:
    """A journal in Python, for interpreters that there is no other for."""

    def __init__(self, kept: int) -> None:
        self._events: deque[bytes] = deque(maxlen=kept)

    def note(self, what: int, number: int, /) -> None:
        self._events.append(pack(time.monotonic_ns(), get_ident(), what, number))

    def put(self, clock_ns: int, thread: int, what: int, number: int, /) -> None:
        self._events.append(pack(clock_ns, thread, what, number))

    def take(self, most: int, /) -> bytes:
        popleft = self._events.popleft
        return b''.join([popleft() for _ in range(min(len(self._events), most))])

    def clear(self) -> None:
        self._events.clear()

    def __len__(self) -> int:
        return len(self._events)


def _load_native() -> Any:
    if os.environ.get(NATIVE_VARIABLE) == '0':
        return None
    try:
        from .. import _journal  # type: ignore[attr-defined]
    except ImportError:
        return None
    # Where the tool is used in place, what was built of an older text of it stays there.
    return _journal if getattr(_journal, 'REVISION', 1) == _REVISION else None


native = _load_native()


def new_journal(kept: int) -> Journal:
    """Give an empty journal of the faster kind that there is."""
    journal: Journal = native.Journal(kept) if native else PlainJournal(kept)
    return journal
