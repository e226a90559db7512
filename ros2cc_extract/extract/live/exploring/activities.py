"""
Which threads are at work, and which wait for their turn.

Runs inside the user's process: the standard library only, nothing else of ours but its
neighbours.
"""

from __future__ import annotations

from types import CodeType
from typing import Any

from ..steering.plan import name_of
from .policies import BEGIN


class Activity:
    """One run of a callback, or what a thread of the program's own does."""

    def __init__(self, key: str, thread: int) -> None:
        self.key = key
        self.thread = thread


class Asked:
    """
    A ready callback whose group is asked.

    :param last: when that was the last time.
    """

    def __init__(self, label: str, entity: Any, now: float) -> None:
        self.label = label
        self.entity = entity
        self.last = now
        self.key = label
        self.at = BEGIN


class Held:
    """A thread that is held at a point of control."""

    def __init__(self, activity: Activity, at: str) -> None:
        self.activity = activity
        self.at = at
        self.granted = False

    @property
    def key(self) -> str:
        return self.activity.key


def label_of(entity: Any) -> str:
    """Name a callback, the same in every process: its function, and what it listens to."""
    function = getattr(entity, 'callback', None)
    function = getattr(function, 'func', function)  # of a partial
    name = getattr(function, '__qualname__', None) or type(entity).__name__
    of = name_of(entity) or type(entity).__name__.lower()
    return f'{str(name).rpartition("<locals>.")[2]} ({of})'


def function_of(code: CodeType) -> str:
    """Name the function that a thread runs, where it runs no callback."""
    return str(getattr(code, 'co_qualname', code.co_name))
