"""
What asks whether a callback may begin, read from the stack of the asking thread.

Source: rclpy 7.1.6 and 9.1.2, ``executors.py``.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FrameType
from typing import Any

_OF_RCLPY = ('rclpy', 'rclpy.executors')


def asks_again() -> bool:
    """Whether the asking thread is in a loop of rclpy that comes back to a refused callback."""
    return any(
        name == 'spin' or name.startswith('spin_until')
        for name, module in _outwards()
        if module in _OF_RCLPY
    )


def is_of_pool() -> bool:
    """Whether it is a worker of a pool: it may wait, as others serve meanwhile."""
    return any(module == 'concurrent.futures.thread' for _, module in _outwards())


def is_nested() -> bool:
    """Whether the thread runs another callback, further out: the one that begins is the first."""
    found = [1 for name, module in _outwards() if (name, module) == ('handler', _OF_RCLPY[1])]
    return len(found) > 1


def _outwards() -> Iterator[tuple[str, Any]]:
    frame: FrameType | None = sys._getframe(2)
    while frame is not None:
        yield frame.f_code.co_name, frame.f_globals.get('__name__')
        frame = frame.f_back
