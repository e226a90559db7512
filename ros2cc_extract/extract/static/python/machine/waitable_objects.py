"""Objects whose only use is that code waits on them and other code ends the wait."""

from __future__ import annotations

from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Instance, Value

OF_LOOP = 'loop future'
OF_POOL = 'pool'
"""Kind of a future that waits when it is asked."""

INITIAL = '__initial__'
"""Slot of a semaphore for its value, and of a queue for its size."""

SETTABLE = frozenset(
    {'event', 'future', OF_LOOP, 'condition', 'queue', 'semaphore', 'barrier', OF_POOL}
)


def is_waited_on(value: Value) -> bool:
    """Whether ``value`` is an event, a future, a queue …"""
    state = value.state if isinstance(value, Instance) else None
    return isinstance(state, PlainState) and state.kind in SETTABLE


def is_of_loop(value: Value) -> bool:
    """Whether ``value`` is a future of asyncio."""
    state = value.state if isinstance(value, Instance) else None
    return isinstance(state, PlainState) and state.kind == OF_LOOP
