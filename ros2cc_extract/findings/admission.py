"""
Goals that are let in because of a state which changes only when their execution begins.

``goal_callback`` accepts, and ``execute`` counts: between the two the next goal may be asked for,
whatever lock each of them holds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from ros2cc_extract.findings.flags import shared_by
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.findings.sections import is_operand
from ros2cc_extract.findings.workers import runs_in_parallel
from ros2cc_extract.spec.deeds import Access
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.order import steps


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
                    yield from _claims(server, execute)


def _serves(server: Callback, execute: Callback) -> bool:
    return (server.node, server.source) == (execute.node, execute.source)


def _claims(server: Callback, execute: Callback) -> Iterator[LateClaim]:
    claimed = {write.name for write in server.writes}
    asked = {read.name: read for read in server.reads if read.admits}
    for name, read in asked.items():
        claim = _claim(name, execute)
        if name not in claimed and claim is not None:
            yield LateClaim(server, read, execute, claim)


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
