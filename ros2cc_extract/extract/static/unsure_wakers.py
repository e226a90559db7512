"""
Wakers that may be gone when somebody waits, or come before he does.

A timer that is cancelled or never started, a callback whose entity or node is destroyed, and what
runs once only, which a condition forgets when nobody waits yet. Sources: rclpy 7.1.6 and 9.1.2,
``node.py`` (``create_timer``), ``timer.py`` (``cancel``, ``reset``), ``executors.py``; CPython
3.12, ``threading.py`` (``Condition.notify``). Where another waker is left, nothing is said.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ros2cc_extract.extract.static.doing import ActivityState
from ros2cc_extract.extract.static.ending import (
    CANCEL,
    DESTROY,
    DESTROY_NODE,
    REMOVE_NODE,
    SHUTDOWN,
)
from ros2cc_extract.extract.static.wakings import ResourceRef, Waking
from ros2cc_extract.extract.static.world import End, EntityState, World
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.deeds import Blocking
from ros2cc_extract.spec.model import When

Names = Callable[[object], str | None]
_DOES = {
    CANCEL: 'cancels the timer of {}, which ends it',
    DESTROY: 'destroys what calls {}, which ends it',
    DESTROY_NODE: 'destroys the node of {}, which ends it',
    REMOVE_NODE: 'takes the node of {}, which ends it, out of the executor',
}


def why_gone(
    world: World, wakers: Sequence[object], is_harmless: Callable[[End], bool], name: Names
) -> Unknown | None:
    """
    Why none of ``wakers`` may be called any more.

    :param is_harmless: of an end that surely comes after the wait.
    """
    reasons = []
    for waker in wakers:
        why = _why_one_is_gone(world, waker, is_harmless, name)
        if why is None:
            return None
        reasons.append(why)
    return reasons[0] if reasons else None


def _why_one_is_gone(
    world: World, waker: object, is_harmless: Callable[[End], bool], name: Names
) -> Unknown | None:
    if not isinstance(waker, EntityState):
        return None
    its_name = name(waker) or 'a callback'
    if waker.dormant is not None and not waker.restarted:
        return Unknown(f'nobody in sight starts the timer of {its_name}', waker.dormant)
    for end in world.ends:
        if _is_of(end, waker) and not _ends_all(end, world) and not is_harmless(end):
            doer = 'a thread' if isinstance(end.doer, ActivityState) else 'a callback'
            does = _DOES[end.kind].format(its_name)
            return Unknown(f'{name(end.doer) or doer} {does}', end.place)
    return None


def _is_of(end: End, waker: EntityState) -> bool:
    is_its_own = end.what is waker and waker.when is not When.CALLBACK  # else made again
    if end.kind == CANCEL:
        return is_its_own and not waker.restarted
    if end.kind == DESTROY:
        return is_its_own
    return end.kind in (DESTROY_NODE, REMOVE_NODE) and end.what is waker.node


def _ends_all(end: End, world: World) -> bool:
    """Whether its doer shuts rclpy down as well."""
    return any(other.doer is end.doer and other.kind == SHUTDOWN for other in world.ends)


def why_lost(
    world: World, block: Blocking, reference: ResourceRef, mine: Sequence[Waking], name: Names
) -> Unknown | None:
    """Why what ends a wait, which comes once only, may come before anybody waits."""
    is_cleared = reference.is_kept and reference.number in world.cleared
    # A loop that asks before it waits misses nothing.
    forgets = block.call == 'Condition.wait' and not block.conditional
    if not mine or not (is_cleared or forgets) or not all(_comes_once(w.by) for w in mine):
        return None
    first = mine[0]
    when = 'before it is cleared' if is_cleared else 'before anybody waits'
    who = name(first.by) or 'a callback'
    return Unknown(f'{who}, which ends it, runs once only, and perhaps {when}', first.place)


def _comes_once(by: object) -> bool:
    if isinstance(by, EntityState):
        return by.one_shot and not by.restarted
    return isinstance(by, ActivityState) and by.count == 1 and not by.loops
