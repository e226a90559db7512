"""
Goals that are let in because of a state which changes only when their execution begins.

``goal_callback`` accepts, and ``execute`` counts: between the two the next goal may be asked for,
no matter which lock each of them holds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.races.critical_sections import is_operand, kept_between
from ros2cc_extract.findings.races.flag_locks import shared_by
from ros2cc_extract.findings.waits.workers import runs_in_parallel
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import FLAG, SHARED, Access
from ros2cc_extract.spec.model import Activity, Callback, EntityKind
from ros2cc_extract.spec.program_order import steps


@dataclass(frozen=True)
class LateClaim:
    """
    What decides whether a goal is let in, and is claimed too late.

    :param asked: the read of the goal callback, of ``server``.
    :param claim: the write by which ``execute`` claims it.
    """

    server: Callback
    asked: Access
    execute: Callback
    claim: Access


def late_claims(context: Context) -> Iterator[LateClaim]:
    """One for each attribute; on one thread the execution begins before the next goal."""
    if not runs_in_parallel(context.unit.executor):
        return
    everybody = shared_by(context)
    for execute in everybody:
        if execute.entity is EntityKind.ACTION_EXECUTE:
            for server in everybody:
                if server.entity is EntityKind.ACTION_SERVER and _serves(server, execute):
                    found = _claims(server, execute)
                    yield from (late for late in found if not _is_reserved(late, context))


def _serves(server: Callback, execute: Callback) -> bool:
    return (server.node, server.source) == (execute.node, execute.source)


def _claims(server: Callback, execute: Callback) -> Iterator[LateClaim]:
    claimed = {write.name for write in server.writes}
    asked = {read.name: read for read in server.reads if read.admits}
    for name, read in asked.items():
        claim = _claim(name, execute)
        if name not in claimed and claim is not None:
            yield LateClaim(server, read, execute, claim)


def _is_reserved(late: LateClaim, context: Context) -> bool:
    """
    Whether the goal callback puts another flag up, which keeps goals out until the claim.

    It asks for both and puts that one up in one hold of a lock, and other writes of that one
    writes what is claimed in one hold with it: no goal finds both down in between.
    """
    doers: tuple[Callback | Activity, ...] = (*context.written, *context.unit.activities)
    server = next(one for one in context.written if one.name == late.server.name)
    name = late.asked.name
    reads = {read.name: read for read in server.reads if read.admits}
    for put_up in server.writes:
        asked = reads.get(put_up.name)
        if asked is None or put_up.name == name or put_up.lowers:
            continue
        locks = _plain(kept_between(asked, put_up, server))
        locks &= _plain(kept_between(late.asked, put_up, server)) & _plain(late.claim.locks)
        others = [(one, write) for one in doers if one is not server for write in one.writes]
        writes = [(one, write) for one, write in others if write.name == put_up.name]
        if locks and all(locks & _held_with(name, write, one) for one, write in writes):
            return True
    return False


def _held_with(name: str, write: Access, doer: Callback | Activity) -> frozenset[str]:
    """The locks that ``doer`` holds from ``write`` to a write of ``name``, or the other way."""
    held = frozenset[str]()
    for other in doer.writes:
        if other.name == name:
            first, last = sorted((write, other), key=steps)
            held |= _plain(kept_between(first, last, doer))
    return held


def _plain(locks: Iterable[str]) -> frozenset[str]:
    return frozenset(lock for lock in locks if not lock.endswith((FLAG, SHARED)))


def _claim(name: str, execute: Callback) -> Access | None:
    """
    The first write of what is given back later; none where ``execute`` looks for itself before.
    """
    writes = sorted((write for write in execute.writes if write.name == name), key=steps)
    if len({steps(write) for write in writes}) < 2 or writes[0].clears:
        return None
    first = writes[0]
    looks = (read for read in execute.reads if read.name == name and not is_operand(read, first))
    return None if any(steps(read) < steps(first) for read in looks) else first
