"""
What code does before it makes an entity comes before the callback of that.

So it is for a transition of a life-cycle node, for ``main``, which runs once, beside a thread that
spins already, and for any other code that makes the entity in one run alone.

A node that is configured once more has destroyed what it made the first time. Source: rclpy 7.1.6,
``lifecycle/node.py`` (the state machine lets nothing go before ``on_configure`` has ended).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.waits.capacity import runs_once
from ros2cc_extract.findings.waits.one_shot_timers import may_cancel_too_late
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access, Act
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, EntityKind, When
from ros2cc_extract.spec.program_order import steps

_FIRST = 'on_configure'


def made_by_several(contexts: Sequence[Context]) -> frozenset[Place | None]:
    """
    Where several may make an entity: what one of them does before it does so is before no other.

    What the set-up makes there, or code without a known caller, is a further entity.
    """
    entities = Counter(each.source for context in contexts for each in context.unit.callbacks)
    makers = {
        (number, one.name, act.source)
        for number, context in enumerate(contexts)
        for one in context.everybody
        for act in one.changes
    }
    times = Counter(source for _, _, source in makers)
    return frozenset(each for each in entities if entities[each] > 1 or times[each] > 1)


def comes_first(doer: Doer) -> bool:
    """Whether it makes what it makes before all others: a transition, or ``main``."""
    if isinstance(doer, Activity):
        return doer.kind is ActivityKind.MAIN
    return doer.entity is EntityKind.LIFECYCLE_SERVICE


def comes_before(access: Access, doer: Doer, other: Doer) -> bool:
    """Whether ``doer`` does this before ``other`` is made, see ``flag_locks.as_shared``."""
    if isinstance(other, Activity):
        return False
    made = [act for act in doer.changes if act.source == other.source]
    if isinstance(doer, Callback) and comes_first(doer) and other.when is When.CONFIGURE:
        return _is_before(access, made) if made else doer.function_name == _FIRST
    if isinstance(doer, Activity) and comes_first(doer):
        return _is_before(access, made)
    return (
        other.when is (When.START if isinstance(doer, Activity) else When.CALLBACK)
        and not comes_first(doer)
        and _is_before(access, made)
        and not any(act.repeats for act in made)
        and (_is_of_one_run(doer) or _is_done_once(access, made))
    )


def _is_before(access: Access, made: Sequence[Act]) -> bool:
    return bool(made) and steps(access) < min(map(steps, made))


def _is_of_one_run(doer: Doer) -> bool:
    """Whether it runs a single time, from its beginning to its end."""
    if isinstance(doer, Activity):
        return doer.kind is ActivityKind.THREAD and doer.count == 1 and not doer.starts
    return doer.count == 1 and runs_once(doer) and not may_cancel_too_late(doer)


def _is_done_once(access: Access, made: Sequence[Act]) -> bool:
    """Whether one flag, never put down again, lets one run alone do both."""
    return any(all(flag in act.held for act in made) for flag in access.locks)
