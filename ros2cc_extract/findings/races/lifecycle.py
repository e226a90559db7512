"""
What a transition of a life-cycle node does before it makes an entity comes before its callback.
So does what ``main`` does, which runs once, beside a thread that spins already.

A node that is configured once more has destroyed what it made the first time. Source: rclpy 7.1.6,
``lifecycle/node.py`` (the state machine lets nothing go before ``on_configure`` has ended).
"""

from __future__ import annotations

from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, EntityKind, When
from ros2cc_extract.spec.program_order import steps

_FIRST = 'on_configure'


def comes_before(access: Access, doer: Callback | Activity, other: Callback | Activity) -> bool:
    """Whether ``doer`` is a transition, or ``main``, that does this before ``other`` is made."""
    if isinstance(other, Activity):
        return False
    if isinstance(doer, Activity):
        made = [steps(act) for act in doer.changes if act.source == other.source]
        return doer.kind is ActivityKind.MAIN and bool(made) and steps(access) < min(made)
    if doer.entity is not EntityKind.LIFECYCLE_SERVICE or other.when is not When.CONFIGURE:
        return False
    made = [steps(act) for act in doer.changes if act.source == other.source]
    return steps(access) < min(made) if made else doer.function_name == _FIRST
