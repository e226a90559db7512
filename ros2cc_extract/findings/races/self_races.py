"""
What two runs of one callback do to each other's shared data.

Three shapes are reported: an update whose old value the other run has read too; a write that rests
on an earlier read, as a test or a copy; and what a run has written, waits, and reads back.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from enum import Enum

from ros2cc_extract.findings.races.critical_sections import (
    is_operand,
    keep_apart,
    kept_between,
    read_acted_on,
    store_the_same,
    waits,
)
from ros2cc_extract.findings.races.uses import Use
from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Callback
from ros2cc_extract.spec.program_order import steps


class SelfRaceKind(Enum):
    """What gets lost, the worst first."""

    LOST_UPDATE = 'lost update'
    STALE_READ = 'stale read'
    OVERWRITTEN = 'overwritten'


@dataclass(frozen=True)
class SelfRace:
    """
    One attribute that two runs of one callback disturb each other by.

    :param use: where it shows; ``callback`` does it.
    :param waits: the callback waits between what it read or wrote first and ``use``.
    :param is_whole: CPython lets no thread in between, as long as it has its global lock.
    """

    kind: SelfRaceKind
    callback: Callback
    use: Use
    waits: bool
    is_whole: bool = False


def self_races_of(callback: Callback, shared: frozenset[str] = frozenset()) -> Iterator[SelfRace]:
    """
    The worst one of each attribute.

    :param shared: attributes in which others store values too. Code that reads one back expects
        that; what no other code stores is taken for what the same run has written.
    """
    for name in dict.fromkeys(access.name for access in callback.writes):
        writes = [access for access in callback.writes if access.name == name]
        found = next(_races_on(writes, callback, name in shared), None)
        if found is not None:
            yield found


def self_races_over_awaits(
    callback: Callback, shared: frozenset[str] = frozenset()
) -> Iterator[SelfRace]:
    """The same of a coroutine on one thread: another run begins only while this one awaits."""
    awaits = tuple(block for block in callback.blocking if kind_of(block) is WaitKind.AWAIT)
    if awaits:
        alone = replace(callback, blocking=awaits)
        yield from (race for race in self_races_of(alone, shared) if race.waits)


def _races_on(writes: list[Access], callback: Callback, is_shared: bool) -> Iterator[SelfRace]:
    plain = [write for write in writes if not write.in_place]
    chosen = [write for write in writes if write.in_place and write.chosen]
    updates = [w for w in plain if w.update and not keep_apart(w.locks, w.locks)]
    lost = [_lost(write, callback) for write in updates]
    yield from (race for race in lost if not race.is_whole)
    stored = [*plain, *chosen]
    stale = [found for write in stored if (found := _stale(write, stored, callback)) is not None]
    yield from sorted((r for r in stale if not r.is_whole), key=lambda race: not race.waits)
    for read in () if is_shared else sorted(callback.reads, key=lambda read: read.asked):
        if _is_overwritten(read, plain, callback):
            yield SelfRace(SelfRaceKind.OVERWRITTEN, callback, Use(callback, read), waits=True)
    yield from (race for race in (*lost, *stale) if race.is_whole)


def _lost(write: Access, callback: Callback) -> SelfRace:
    use, begun = Use(callback, write), replace(write, turn=())
    has_waited = waits(begun, write, callback)
    return SelfRace(SelfRaceKind.LOST_UPDATE, callback, use, has_waited, is_whole=write.whole)


def _stale(write: Access, writes: list[Access], callback: Callback) -> SelfRace | None:
    """A write because of a read that another run may have made wrong."""
    read = read_acted_on(write, callback) if write.in_place or not write.update else None
    if read is None:
        return None
    kept = kept_between(read, write, callback)
    if all(keep_apart(kept, other.locks) for other in writes):
        return None
    at_once = is_operand(read, write)
    kind = SelfRaceKind.LOST_UPDATE if at_once else SelfRaceKind.STALE_READ
    has_waited = waits(read, write, callback)
    is_whole = write.whole and at_once
    return SelfRace(kind, callback, Use(callback, write), has_waited, is_whole)


def _is_overwritten(read: Access, writes: list[Access], callback: Callback) -> bool:
    """Whether a run reads, after a wait, what it has written before."""
    stored = [write for write in writes if write.name == read.name]
    own = [write for write in stored if steps(write) < steps(read) and not write.update]
    last = max(own, key=steps, default=None)
    if last is None or read.compared or read.fresh or not waits(last, read, callback):
        return False
    if store_the_same(stored):
        return False
    return not keep_apart(kept_between(last, read, callback), last.locks)
