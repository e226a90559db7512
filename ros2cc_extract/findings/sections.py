"""Which accesses to shared data cannot meet: by a lock, or because they mean other items."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.findings.order import steps
from ros2cc_extract.spec.deeds import SHARED, Access
from ros2cc_extract.spec.model import Activity, Callback


def is_other_item(one: Access, other: Access) -> bool:
    """True for two items of one container, whose constant keys differ."""
    return one.item is not None and other.item is not None and one.item != other.item


def kept_between(first: Access, last: Access, callback: Callback | Activity) -> tuple[str, ...]:
    """
    The locks that are held from the one access to the other.

    A lock that the callback takes again on its way to ``last`` was given back in between, unless
    ``last`` holds it twice, as an ``RLock`` can be.
    """
    anew = {
        act.name
        for act in callback.locks
        if steps(first) < steps(act) < steps(last) and act.chain == last.chain[: len(act.chain)]
    }
    return tuple(
        lock
        for lock in dict.fromkeys(last.locks)
        if lock in first.locks
        and (lock.removesuffix(SHARED) not in anew or last.locks.count(lock) > 1)
    )


def read_for(deed: Access, doer: Callback | Activity) -> Access | None:
    """The last read before a deed that rests on one; ``None`` if the doer has stored since."""
    reads = [
        read
        for read in doer.reads
        if read.name == deed.name and (steps(read) < steps(deed) or is_operand(read, deed))
    ]
    last = max(reads, key=steps, default=None)
    stored = (write for write in doer.writes if write.name == deed.name and not write.in_place)
    if last is None or any(steps(last) < steps(write) < steps(deed) for write in stored):
        return None
    return last


def keep_apart(one: Sequence[str], other: Sequence[str]) -> bool:
    """True when a lock is held by both, and by one of them alone."""
    bare = {lock.removesuffix(SHARED) for lock in one} & {
        lock.removesuffix(SHARED) for lock in other
    }
    return any(lock in one or lock in other for lock in bare)


def is_operand(read: Access, write: Access) -> bool:
    """True for what is read in the value or the arguments, on the line of the write."""
    at, to = read.source, write.source
    if at is None or to is None or read.chain != write.chain:
        return False
    return (at.file, at.line) == (to.file, to.line) and (at.column or 0) > (to.column or 0)
