"""Callbacks that see to it themselves that only one of their runs waits."""

from __future__ import annotations

from ros2cc_extract.spec.deeds import Access
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.spec.order import steps


def lets_one_wait(callback: Callback) -> bool:
    """
    True when a run looks at a state and claims it under one lock, waits, and gives it back.

    ``with lock: if busy: return``, ``busy = True``; wait; ``with lock: busy = False``. Whoever
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


def _is_looked_at(claim: Access, callback: Callback) -> bool:
    return any(
        read.name == claim.name
        and set(read.locks) & set(claim.locks)
        and steps(read) < steps(claim)
        for read in callback.reads
    )
