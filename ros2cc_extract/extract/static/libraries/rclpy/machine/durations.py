"""Durations of clocks: how long one sleeps, as far as the source says."""

from __future__ import annotations

import ast

from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.values.values import Call, Instance, Mystery, Value
from ros2cc_extract.extract.static.python.values.values import Library as Name
from ros2cc_extract.source_locations import Unknown

CLOCKS = {'sleep_for': 'Clock.sleep_for', 'sleep_until': 'Clock.sleep_until'}
"""Methods that nothing but a clock has; the clock of a node is not followed."""

DURATION = Unknown('a duration that could not be followed')

THE_CLOCK = 'the clock'
"""What stands for the clock of a node, and for its time."""
_DURATION, _LATER = 'duration', 'time from now'


def slept(call: Call) -> Value:
    """How long a clock sleeps: for a duration, or until one from now."""
    given = call.argument(0, 'rel_time') or call.argument(0, 'until')
    state = given.state if isinstance(given, Instance) else None
    is_known = isinstance(state, PlainState) and state.kind in (_DURATION, _LATER)
    return state.key if is_known and state is not None and state.key else Mystery(DURATION)


def time_from_now(op: ast.operator, left: Value, right: Value) -> Instance | None:
    """``clock.now() + Duration(…)``."""
    is_now = isinstance(left, Mystery) and left.unknown.reason == THE_CLOCK
    if not is_now or not isinstance(op, ast.Add) or not isinstance(right, Instance):
        return None
    state = right.state
    if not isinstance(state, PlainState) or state.kind != _DURATION:
        return None
    time = Instance(Name('rclpy.time.Time'), right.place)
    time.state = PlainState(_LATER, state.key, place=right.place)
    return time
