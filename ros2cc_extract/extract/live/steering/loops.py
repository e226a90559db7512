"""
Loops of asyncio that sleep although something is ready: nothing has woken them.

A loop that has something ready does not sleep, and what is handed over by
`call_soon_threadsafe` wakes it. Source: Python 3.10 to 3.14, ``asyncio/base_events.py``
(`_run_once`: a time-out of 0 where something is ready), ``selectors.py``.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import sys
from types import FrameType
from typing import Any


def asleep() -> list[dict[str, int]]:
    """Loops that wait for a file or the time while something is ready, and what that is."""
    found = []
    for thread, frame in sys._current_frames().items():
        loop = _sleeping(frame)
        first = _first_ready(loop)
        if first is not None:
            found.append({'thread': thread, 'loop': id(loop), 'first': id(first)})
    return found


def _sleeping(frame: FrameType | None) -> Any:
    """The loop of a thread whose innermost function of Python is the wait of that loop."""
    if frame is None or frame.f_code.co_name != 'select':
        return None
    outer = frame.f_back
    while outer is not None and outer.f_code.co_name != '_run_once':
        outer = outer.f_back
    if outer is None or outer.f_globals.get('__name__') != 'asyncio.base_events':
        return None
    known = outer.f_locals
    return known.get('self') if known.get('timeout', 0) != 0 else None


def _first_ready(loop: Any) -> Any:
    try:
        return loop._ready[0]
    except (AttributeError, IndexError, TypeError):
        return None
