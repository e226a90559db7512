"""
Publishers that are destroyed while other code may publish by them.

Source: rclpy 7.1.6, ``publisher.py`` (``publish`` takes the handle, which raises ``InvalidHandle``
when it was destroyed) and ``node.py`` (``destroy_publisher`` gives the handle back at once).
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef
from ros2cc_extract.extract.static.libraries.rclpy.machine.end_operations import (
    PUBLISHED,
    executor_of,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import (
    End,
    EntityState,
    GroupState,
    NodeEnd,
    RosWorld,
)
from ros2cc_extract.extract.static.python.machine.library_state import PlainState
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog
from ros2cc_extract.extract.static.python.values.values import Const, Instance
from ros2cc_extract.extract.static.units.whole_program.threads_until_shutdown import (
    loops_around,
    spins_end_by_themselves,
)
from ros2cc_extract.spec.model import ActivityKind, GroupType

_Doer = EntityState | ActivityState


def published_meanwhile(end: End, publisher: Instance, world: RosWorld) -> Iterator[Diagnostic]:
    """Report the first that may still publish when ``end`` destroys ``publisher``."""
    for use in world.ends:
        is_of_it = use.kind == PUBLISHED and use.what is publisher
        if is_of_it and _may_meet(end, use):
            yield _diagnostic(end, use, publisher)
            return


def used_behind_the_node(end: NodeEnd, world: RosWorld) -> Iterator[Diagnostic]:
    """Report a thread that may still publish when the main program destroys its node."""
    if not spins_end_by_themselves(world):
        return
    for use in world.ends:
        doer = use.doer
        if use.kind != PUBLISHED or not isinstance(doer, ActivityState):
            continue
        is_over = any(id(runner) in end.over for runner in doer.runners)
        is_thread = doer.kind is ActivityKind.THREAD and not is_over
        if is_thread and _is_of(use, end.node) and _goes_on(use, doer, world):
            yield _behind_the_node(end, use)
            return


def _is_of(use: End, node: object) -> bool:
    state = use.what.state if isinstance(use.what, Instance) else None
    return isinstance(state, PlainState) and state.of is node


def _goes_on(use: End, thread: ActivityState, world: RosWorld) -> bool:
    """Whether the thread publishes there again and again."""
    return thread.loops or any(True for _ in loops_around(use.place, world))


def _may_meet(end: End, use: End) -> bool:
    one, other = end.doer, use.doer
    if one is other or _is_kept_apart(end, use):
        return False
    if isinstance(one, EntityState) and isinstance(other, EntityState):
        return _may_overlap(one, other)
    threads = [doer for doer in (one, other) if isinstance(doer, ActivityState)]
    is_plain = all(each.kind not in (ActivityKind.MAIN, ActivityKind.PROCESS) for each in threads)
    return is_plain and not _has_joined(end, other) and not _starts(one, other)


def _is_kept_apart(end: End, use: End) -> bool:
    """Whether the destroying code first takes a lock under which is published."""
    effects = end.doer.effects or EffectLog()
    taken = {act.name for act in effects.locks} | set(end.locks)
    return not taken.isdisjoint(use.locks)


def _has_joined(end: End, other: _Doer) -> bool:
    """Whether the code that destroys the publisher waits for the end of that thread somewhere."""
    if not isinstance(other, ActivityState):
        return False
    runners = {id(runner) for runner in other.runners}
    waits = (end.doer.effects or EffectLog()).blocking
    waited = (block.resource for block in waits)
    return any(isinstance(each, ResourceRef) and each.number in runners for each in waited)


def _starts(one: _Doer, other: _Doer) -> bool:
    """Whether the one starts the other: what comes first is not looked into."""
    pairs = ((one, other), (other, one))
    return any(
        isinstance(each, ActivityState) and any(start.by is by for start in each.starts)
        for each, by in pairs
    )


def _may_overlap(one: EntityState, other: EntityState) -> bool:
    executors = executor_of(one.node), executor_of(other.node)
    if executors[0] is None or executors[1] is None:
        return False
    if executors[0] is not executors[1]:
        return True
    groups = one.group.state, other.group.state
    is_known = all(isinstance(g, GroupState) and g.unresolved is None for g in groups)
    is_shut = one.group is other.group and groups[0].type is GroupType.EXCLUSIVE
    return is_known and executors[0].state.threads != 1 and not is_shut


def _behind_the_node(end: NodeEnd, use: End) -> Diagnostic:
    return Diagnostic(
        severity=Severity.WARNING,
        slug='served-no-more',
        place=end.place,
        message=f'the node is destroyed while a thread may still publish by it ({use.place}): '
        'that raises InvalidHandle there',
        help='end the thread and join it first',
    )


def _diagnostic(end: End, use: End, publisher: Instance) -> Diagnostic:
    state = publisher.state
    key = state.key if isinstance(state, PlainState) else None
    name = f' of {key.value!r}' if isinstance(key, Const) else ''
    who = 'a thread' if isinstance(use.doer, ActivityState) else 'another callback'
    return Diagnostic(
        severity=Severity.WARNING,
        slug='served-no-more',
        place=end.place,
        message=f'this publisher{name} is destroyed while {who} may use it ({use.place}): that '
        'raises InvalidHandle there',
        help='end the thread first, or publish and change the publisher under one lock, and '
        'destroy the old one after that'
        if isinstance(use.doer, ActivityState)
        else 'publish and change the publisher under one lock, or keep both in one mutually '
        'exclusive group',
    )
