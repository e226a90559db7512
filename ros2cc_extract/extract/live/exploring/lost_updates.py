"""
Notices lost updates: a value was read, another thread has written, and what rests on the value
that was read is written over it.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

from ..steering.values import NOTHING, copied, shown, target, value
from .marks import READ, WRITE, Mark

Report = Callable[..., None]


class Writers:
    """Which thread has written what last, of all objects that were ever written here."""

    def __init__(self) -> None:
        self._of: dict[tuple[int, str], int] = {}

    def note(self, owner: Any, attribute: str) -> None:
        self._of[id(owner), attribute] = threading.get_ident()

    def is_other(self, owner: Any, attribute: str) -> bool:
        """Whether another thread was the last to write."""
        return self._of.get((id(owner), attribute)) not in (None, threading.get_ident())


class Accesses:
    """
    What one call of a function has read, and writes.

    :param report: called with a lost update.
    """

    def __init__(self, writers: Writers, report: Report) -> None:
        self._writers = writers
        self._report = report
        self._read: dict[str, tuple[Any, int]] = {}
        self._lost: dict[str, Any] | None = None

    def before(self, mark: Mark, frame: FrameType) -> None:
        """The thread is about to run a marked instruction, and is no longer held."""
        if mark.kind != WRITE or not mark.rests or mark.attribute not in self._read:
            return
        owner = _owner(frame, mark)
        read, line = self._read[mark.attribute]
        now = _value(owner, mark.attribute)
        differs = read is not NOTHING and now is not NOTHING and shown(read) != shown(now)
        if differs and self._writers.is_other(owner, mark.attribute):
            self._lost = {'read': shown(read), 'other': shown(now), 'read_line': line}

    def after(self, mark: Mark, frame: FrameType) -> None:
        """It has run the instruction."""
        owner = _owner(frame, mark)
        if mark.kind == READ:
            self._read[mark.attribute] = copied(_value(owner, mark.attribute)), mark.line
        elif mark.kind == WRITE:
            own = copied(_value(owner, mark.attribute))
            self._writers.note(owner, mark.attribute)
            self._read[mark.attribute] = own, mark.line
            lost, self._lost = self._lost, None
            # A thread that only stores the value of the other one loses no update.
            if lost is not None and (mark.computed or shown(own) != lost['other']):
                self._report(mark, own=shown(own), **lost)


def _owner(frame: FrameType, mark: Mark) -> Any:
    """Whose attribute it is; of a global name its module."""
    owner = target(frame)
    if value(owner, mark.attribute) is NOTHING and mark.attribute in frame.f_globals:
        return frame.f_globals
    return owner


def _value(owner: Any, attribute: str) -> Any:
    return owner.get(attribute, NOTHING) if isinstance(owner, dict) else value(owner, attribute)
