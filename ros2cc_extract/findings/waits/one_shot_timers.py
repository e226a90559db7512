"""
Timers that cancel themselves, and wait before they do.

Until then the timer is due again with every period, and a group that refuses nothing starts a
further run beside the first one. Source: rclpy 7.1.6, ``executors.py`` (``_take_timer``: the next
period begins when a run does), ``timer.py`` (``cancel``).
"""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.spec.effects import CANCELS, Act, Blocking
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.spec.program_order import steps
from ros2cc_extract.verify.results.rates import least_slept_s


def cancel_of(callback: Callback) -> Act | None:
    """Where a timer cancels itself once and for all, if it has waited by then."""
    if not callback.one_shot:
        return None
    return next((act for act in callback.changes if act.name == CANCELS), None)


def waits_before_cancel(callback: Callback) -> Sequence[Blocking]:
    """What a timer waits for before it cancels itself."""
    cancel = cancel_of(callback)
    if cancel is None:
        return ()
    return [block for block in callback.blocking if steps(block) < steps(cancel)]


def cancels_too_late(callback: Callback) -> bool:
    """Whether the timer is surely due again before it cancels itself."""
    waits, period = waits_before_cancel(callback), callback.period_s
    return bool(waits) and isinstance(period, float) and least_slept_s(waits) >= period


def may_cancel_too_late(callback: Callback) -> bool:
    """The same of a timer whose waits may last longer than its period."""
    waits, period = waits_before_cancel(callback), callback.period_s
    slept = [b.seconds * b.times for b in waits if isinstance(b.seconds, (int, float))]
    is_slept = all(kind_of(b) is WaitKind.SLEEP for b in waits) and len(slept) == len(waits)
    return bool(waits) and not (is_slept and isinstance(period, float) and sum(slept) < period)
