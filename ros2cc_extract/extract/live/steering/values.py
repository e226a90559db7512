"""
What an attribute holds, read from a frame without running anything of the program but `repr`.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

from types import FrameType
from typing import Any

NOTHING = object()
"""There is no such attribute."""
_LONGEST = 120


def target(frame: FrameType) -> Any:
    """Return the object that has the attribute: the first argument."""
    names = frame.f_code.co_varnames
    return frame.f_locals.get(names[0], NOTHING) if names else NOTHING


def value(of: Any, name: str) -> Any:
    """What the attribute holds, without asking a property."""
    return getattr(of, '__dict__', {}).get(name, NOTHING)


def copied(held: Any) -> Any:
    """What changes in place is kept as it reads now."""
    immutable = isinstance(held, (int, float, str, bytes, tuple, frozenset, type(None)))
    return held if immutable or held is NOTHING else _Text(shown(held))


class _Text:
    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def shown(held: Any) -> str:
    """A value as it reads, in a line."""
    if held is NOTHING:
        return '?'
    try:
        return repr(held)[:_LONGEST]
    except Exception:
        return f'a {type(held).__name__}'
