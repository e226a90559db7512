"""Which accesses to shared data cannot meet: by a lock, or because they mean other items."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ros2cc_extract.identity_memo import known_of, once
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import BEGINS, SHARED, Access, Act
from ros2cc_extract.spec.model import Activity, Callback
from ros2cc_extract.spec.program_order import steps


def is_other_item(one: Access, other: Access) -> bool:
    """True for two items of one container, whose constant keys differ, or begin differently."""
    if one.item is None or other.item is None:
        return False
    if not (one.item.endswith(BEGINS) or other.item.endswith(BEGINS)):
        return one.item != other.item
    whole, part = sorted((one.item, other.item), key=lambda item: item.endswith(BEGINS))
    letters, beginning = _letters(whole), _letters(part)
    if letters is None or beginning is None:
        return False
    shared = min(len(letters), len(beginning)) if whole.endswith(BEGINS) else len(beginning)
    return letters[:shared] != beginning[:shared]


def is_same_item(one: Access, other: Access) -> bool:
    """True for one item of one container, by its constant key."""
    return one.item is not None and one.item == other.item and not one.item.endswith(BEGINS)


def _letters(item: str) -> str | None:
    """What stands between the quotes of a text, whose escapes are the same in each."""
    quoted = item.removesuffix(BEGINS)
    is_text = len(quoted) > 1 and quoted[0] == quoted[-1] == "'"
    return quoted[1:-1] if is_text else None


def kept_between(first: Access, last: Access, callback: Callback | Activity) -> tuple[str, ...]:
    """
    The locks that are held from the one access to the other.

    A lock that the callback takes again on its way to ``last`` was given back in between, unless
    ``last`` holds it twice, as an ``RLock`` can be.
    """
    if not last.locks:
        return ()
    begin, end = steps(first), steps(last)
    anew = {
        act.name
        for act in callback.locks
        if begin < steps(act) < end and act.chain == last.chain[: len(act.chain)]
    }
    return tuple(
        lock
        for lock in dict.fromkeys(last.locks)
        if lock in first.locks
        and (lock.removesuffix(SHARED) not in anew or last.locks.count(lock) > 1)
    )


def read_for(effect: Access, doer: Callback | Activity) -> Access | None:
    """The last read before a effect that rests on one; ``None`` if the doer has stored since."""
    known = known_of(doer).setdefault(read_for, {})
    if id(effect) not in known:
        # Kept with its effect, so that no other one gets its number.
        known[id(effect)] = effect, _read_for(effect, doer)
    found: Access | None = known[id(effect)][1]
    return found


def read_acted_on(
    write: Access, doer: Callback | Activity, rival: Access | None = None
) -> Access | None:
    """
    The read on which a write rests that its ``rival`` can make wrong, in another run its own.

    Items that two change in place may be different ones, except where both have looked for one in
    the collection, and the doer has waited since: then the other finds the same.
    """
    both_chosen = write.chosen and (rival is None or rival.chosen or not rival.in_place)
    if not write.rests or (write.in_place and not both_chosen):
        return None
    read = read_for(write, doer)
    return read if read is None or not write.in_place or waits(read, write, doer) else None


def waits(first: Access, last: Access, doer: Callback | Activity) -> bool:
    """Whether ``doer`` waits between the two."""
    return any(steps(first) < steps(block) < steps(last) for block in doer.blocking)


def _read_for(effect: Access, doer: Callback | Activity) -> Access | None:
    end = steps(effect)
    reads = [
        (at, read)
        for at, read in reads_of(doer).get(effect.name, ())
        if at < end or is_operand(read, effect)
    ]
    if not reads:
        return None
    begin, last = max(reads, key=lambda pair: pair[0])
    stored = (write for write in writes_of(doer).get(effect.name, ()) if not write.in_place)
    return None if any(begin < steps(write) < end for write in stored) else last


@once
def reads_of(
    doer: Callback | Activity,
) -> Mapping[str, Sequence[tuple[tuple[Place, ...], Access]]]:
    """Its reads by name, each with the way to it."""
    found: dict[str, list[tuple[tuple[Place, ...], Access]]] = {}
    for read in doer.reads:
        found.setdefault(read.name, []).append((steps(read), read))
    return found


@once
def writes_of(doer: Callback | Activity) -> Mapping[str, Sequence[Access]]:
    """Its writes by name."""
    found: dict[str, list[Access]] = {}
    for write in doer.writes:
        found.setdefault(write.name, []).append(write)
    return found


def store_the_same(writes: Sequence[Access]) -> bool:
    """Whether all store one constant: nothing is lost or gained by whose it is that is read."""
    are_false = all(write.clears for write in writes) or all(write.lowers for write in writes)
    is_one = len({write.source for write in writes}) == 1
    return are_false or (is_one and all(write.literal for write in writes))


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


def is_read_before(read: Access, act: Act, write: Access) -> bool:
    """
    Whether ``act`` stands between the two, or on the line of a write that rests on the read.

    A plain update rests only on what it reads where it writes.
    """
    if steps(read) < steps(act) < steps(write):
        return write.rests or _line_of(read) == _line_of(write)
    depth, at = len(write.chain), write.source
    way = steps(act)[depth : depth + 1] if act.chain[:depth] == write.chain else ()
    return is_operand(read, write) and any(
        at is not None and (place.file, place.line) == (at.file, at.line) for place in way
    )


def _line_of(access: Access) -> tuple[str, int] | None:
    return (access.source.file, access.source.line or 0) if access.source is not None else None
