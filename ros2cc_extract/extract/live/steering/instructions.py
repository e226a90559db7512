"""
Have Python report each instruction of a call, in every version that can.

Source: Python, ``sys.settrace``; ``Objects/frameobject.c`` and ``Python/legacy_tracing.c`` of 3.12
and 3.13.

Runs inside the user's process: the standard library only.
"""

from __future__ import annotations

import sys
from functools import cache
from types import FrameType
from typing import Any

# With its global lock, CPython from 3.10 on switches threads only there: at calls, and where a
# loop goes back (``ceval.c``, the eval breaker), or where C code lets the lock go.
SWITCHES = (
    'CALL', 'PRECALL', 'JUMP_BACKWARD', 'JUMP_ABSOLUTE', 'FOR_ITER', 'SEND', 'YIELD', 'RESUME',
    'BEFORE_WITH', 'SETUP_WITH', 'WITH_EXCEPT', 'IMPORT', 'POP_JUMP_BACKWARD',
)  # fmt: skip


def has_global_lock() -> bool:
    """Whether one thread at a time runs Python code; from Python 3.13 on it may not be so."""
    enabled = getattr(sys, '_is_gil_enabled', None)
    return enabled is None or bool(enabled())


@cache
def allow_instructions() -> None:
    """
    Before ``sys.settrace``: Python 3.12 asks only there whether a tracer wants instructions.

    Once is enough for all threads, and must be: CPython 3.12.1 crashes in a function that has
    asked for itself and runs once more in another thread (seen on 3.12.1, not on 3.11.7, 3.13.0).
    """
    sys._getframe().f_trace_opcodes = True


def trace_instructions(frame: FrameType) -> None:
    """At the begin of a call: Python 3.13 wants the frame to have a trace function first."""
    if frame.f_trace is None:
        frame.f_trace = _until_the_real_one
    frame.f_trace_opcodes = True


def _until_the_real_one(_frame: FrameType, _event: str, _argument: Any) -> None:
    return None
