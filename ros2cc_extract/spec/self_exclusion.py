"""Callbacks of which only one run waits: they see to it themselves, or run once."""

from __future__ import annotations

from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Callback, EntityKind, GroupType, Spec, When
from ros2cc_extract.spec.program_order import steps


def is_made_once(callback: Callback) -> bool:
    """
    True for a task that is made at one known place, once, before anything spins: it runs once.

    Source: rclpy 7.1.6 and 9.1.2, ``executors.py`` (``create_task``, ``_wait_for_ready_callbacks``
    forgets a task that is done).
    """
    is_task = callback.entity in (EntityKind.TASK, EntityKind.DONE_CALLBACK)
    is_one = callback.when is When.START and callback.count == 1
    return is_task and is_one and callback.source is not None


def lets_one_wait(callback: Callback) -> bool:
    """
    True when a run looks at a state and claims it under one lock, waits, and gives it back.

    ``with lock: if busy: return``, ``busy = True``; wait; ``with lock: busy = False``. Code that
    looks again after the wait does not own the state: others may have changed it meanwhile.
    """
    waits = sorted(map(steps, callback.blocking))
    if not waits:
        return False
    given_back = {write.name for write in callback.writes if steps(write) > waits[-1]}
    given_back -= {read.name for read in callback.reads if steps(read) > waits[0]}
    return any(
        write.name in given_back
        and not write.update
        and steps(write) < waits[0]
        and _is_looked_at(write, callback)
        for write in callback.writes
    )


def admits_one(execute: Callback, spec: Spec) -> bool:
    """
    True when a goal callback lets one goal in at a time: it claims what the execution gives back.

    Of its own runs one at a time asks and claims, by its group or under one lock.
    """
    waits = sorted(map(steps, execute.blocking))
    given_back = {write.name for write in execute.writes if waits and steps(write) > waits[-1]}
    servers = (each for each in spec.callbacks if each.entity is EntityKind.ACTION_SERVER)
    return any(
        read.admits and read.name in given_back and _is_claimed(read, server, spec)
        for server in servers
        if (server.node, server.source) == (execute.node, execute.source)
        for read in server.reads
    )


def _is_claimed(asked: Access, server: Callback, spec: Spec) -> bool:
    group = spec.group_of(server)
    is_alone = group.type is GroupType.EXCLUSIVE and group.unresolved is None
    return any(
        claim.name == asked.name
        and not claim.update
        and steps(asked) < steps(claim)
        and (is_alone or bool(set(asked.locks) & set(claim.locks)))
        for claim in server.writes
    )


def _is_looked_at(claim: Access, callback: Callback) -> bool:
    return any(
        read.name == claim.name
        and set(read.locks) & set(claim.locks)
        and steps(read) < steps(claim)
        for read in callback.reads
    )
