"""
Waits that end by themselves a number of times, and never after that.

The room in a bounded queue and the value of a semaphore are used up by runs before. Models leave
such a wait open; but if nothing that gives back can run during the wait, it never ends.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.waits.waits import Wait, kind_of
from ros2cc_extract.findings.waits.workers import honours_groups, is_one_thread
from ros2cc_extract.spec.effects import BY_ITSELF, POLLING_LOOP, WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import Activity, Callback

# What they ask for may be there already, for all runs of the thread.
_OF_LOOPS = (POLLING_LOOP, WORKING_LOOP)


def used_up(context: Context) -> Iterator[Wait]:
    """Waits of callbacks that never end once nothing is left."""
    for caller in context.written:
        for block in caller.blocking:
            if is_used_up(block, caller, context):
                yield Wait(caller, block, kind_of(block))


def is_used_up(block: Blocking, caller: object, context: Context) -> bool:
    """Whether all that give back are kept from it by the one that waits."""
    if not isinstance(caller, Callback) or block.seconds is not None:
        return False
    if block.escapes is None or not block.escapes.reason.endswith(BY_ITSELF):
        return False
    own = [waker for waker in block.wakers if waker.by == caller.name]
    taken = sum(b.times for b in caller.blocking if _is_for_the_same(b, block))
    if len(own) >= taken:
        return False  # it gives back itself what it takes, perhaps on a branch
    return all(_is_held_up(waker.by, caller, context) for waker in block.wakers)


def _is_held_up(name: str, caller: Callback, context: Context) -> bool:
    """A callback that cannot run meanwhile, or a thread that may wait for such ones by then."""
    giver = context.doer_by_name.get(name)
    if isinstance(giver, Activity):
        return bool(kept_for(giver, caller, context))
    return giver is not None and _is_kept(giver, caller, context)


def kept_for(giver: Activity, caller: Callback, context: Context) -> tuple[Callback, ...]:
    """What a thread may wait for that cannot run while ``caller`` waits, if nothing else can."""
    for block in giver.blocking:
        if block.seconds is None and block.escapes is None and block.call not in _OF_LOOPS:
            needed = [context.by_name.get(waker.by) for waker in block.wakers]
            kept = [each for each in needed if each is not None and each is not caller]
            if (
                kept
                and len(kept) == len(needed)
                and all(_is_kept(each, caller, context) for each in kept)
            ):
                return tuple(kept)
    return ()


def _is_for_the_same(one: Blocking, other: Blocking) -> bool:
    return one.resource == other.resource and one.call == other.call


def _is_kept(giver: Callback, caller: Callback, context: Context) -> bool:
    executor = context.unit.executor
    if is_one_thread(executor):
        return True
    group = context.exclusive_group(caller)
    return group is not None and honours_groups(executor) and giver.group == group.name
