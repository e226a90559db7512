"""
Shared state that callbacks and threads which may overlap change without a common lock.

A plain assignment is atomic in CPython; what breaks is *read, then write*: an update
(``self.n += 1``) or a test followed by an assignment. So those weigh more; two updates in place
(``append``) do not disturb each other, unless one of them rests on what was read before
(``d[k] = d.get(k) + 1``). That one may mean another item, so it weighs less.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from enum import Enum
from itertools import combinations

from ros2cc_extract.findings.base.model import Remark
from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.base.wording import called, listing
from ros2cc_extract.findings.races import happens_before
from ros2cc_extract.findings.races.critical_sections import (
    is_operand,
    is_other_item,
    is_read_before,
    is_same_item,
    keep_apart,
    kept_between,
    read_acted_on,
    reads_of,
    waits,
    writes_of,
)
from ros2cc_extract.findings.races.flag_locks import as_shared, shared_by
from ros2cc_extract.findings.races.found_states import changes_nothing, store_alike
from ros2cc_extract.findings.races.harms import (
    bare_uses_cleared,
    overwritten,
    torn_messages,
    torn_states,
    uses_cleared,
    written_before,
)
from ros2cc_extract.findings.races.loops_over_data import (
    changed_in_loop,
    emptied,
    gone_in_between,
    leaves_enough,
    shrunk_in_loop,
    taken_in_between,
)
from ros2cc_extract.findings.races.made_later import comes_before
from ros2cc_extract.findings.races.shared_objects import node_classes, shared_part
from ros2cc_extract.findings.races.uses import Use
from ros2cc_extract.findings.waits.concurrent_threads import (
    beside,
    node_of,
    repeats_freely,
    sharing,
)
from ros2cc_extract.findings.waits.overlap import Overlap, interleaves, overlap
from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.identity_memo import once
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.model import Activity, Callback
from ros2cc_extract.spec.program_order import steps
from ros2cc_extract.verify.results.evidence import Evidence


class RaceKind(Enum):
    """What goes wrong, the worst first."""

    CHANGED_IN_LOOP = 'changed in a loop'
    CLEARED_IN_USE = 'cleared in use'
    TORN = 'torn'
    EMPTIED = 'emptied after a look'
    SHRUNK_IN_LOOP = 'shrunk in a loop'
    TAKEN = 'taken in between'
    GONE = 'gone in between'
    OVERWRITTEN = 'overwritten'
    LOST_UPDATE = 'lost update'
    CHECK_THEN_ACT = 'check then act'
    CHECK_THEN_CHANGE = 'check then change'
    WHOLE_UPDATE = 'update in one piece'
    TORN_STATE = 'torn state'
    LAST_WRITE_WINS = 'last write wins'


_OWN_HARM = (
    RaceKind.CHANGED_IN_LOOP,
    RaceKind.CLEARED_IN_USE,
    RaceKind.TORN,
    RaceKind.TORN_STATE,
    RaceKind.EMPTIED,
    RaceKind.SHRUNK_IN_LOOP,
    RaceKind.TAKEN,
    RaceKind.GONE,
    RaceKind.OVERWRITTEN,
)
"""What not every other write does."""
LOSING = (RaceKind.LOST_UPDATE, RaceKind.CHECK_THEN_ACT, RaceKind.WHOLE_UPDATE)


@dataclass(frozen=True)
class Race:
    """
    Attributes that callbacks may change at the same time.

    :param names: of the attributes; several when the same callback loses against the same others.
    :param first: the write at which something gets lost, of the first attribute.
    :param others: the writes that may come in between, one per callback.
    :param run: a run of the model in which two of them overlap.
    :param is_flag: what a thread and another test and write is a constant.
    """

    names: tuple[str, ...]
    kind: RaceKind
    first: Use
    others: tuple[Use, ...]
    run: Evidence | None
    is_flag: bool = False

    @property
    def is_outside_groups(self) -> bool:
        """True when one of the callbacks is in no group at all."""
        return any(
            isinstance(use.doer, Callback) and use.doer.groupless
            for use in (self.first, *self.others)
        )

    @property
    def has_threads(self) -> bool:
        """True when one of them is a thread of the program's own."""
        return _is_of_threads(self.first, *self.others)

    @property
    def subjects(self) -> tuple[str, ...]:
        """The attributes and the callbacks, which identify the race."""
        callbacks = (self.first, *self.others)
        return (*self.names, *dict.fromkeys(use.doer.name for use in callbacks))

    @property
    def is_meant_whole(self) -> bool:
        """Whether what the other writes in pieces belongs together, and shows for sure."""
        return any(
            (last.akin and waits(first, last, use.doer))
            or bool(kept_between(first, last, use.doer))
            for use in self.others
            for last in use.doer.writes
            if last.name in self.names and (first := written_before(last, use.doer)) is not None
        )

    def related(self) -> tuple[Remark, ...]:
        """The other writes, each line once."""
        writes = self.others
        if self.kind is RaceKind.TORN_STATE:
            pairs = [(use.doer, name) for use in self.others for name in self.names]
            writes = tuple(Use(d, w) for d, name in pairs for w in writes_of(d).get(name, ())[:1])
        alike: dict[tuple[Place, str], list[str]] = {}
        for use in writes:
            alike.setdefault((use.place, use.access.name), []).append(called(use.doer))
        return tuple(
            Remark(place, f'{listing(doers)} write{"s" * (len({*doers}) == 1)} {name} here')
            for (place, name), doers in alike.items()
        )


@dataclass(frozen=True)
class _Conflict:
    kind: RaceKind
    first: Use
    other: Use
    run: Evidence | None


@once
def races_of(context: Context) -> tuple[Race, ...]:
    """One race per attributes that the same callbacks change, in the order of first conflicts."""
    by_attribute: dict[tuple[str, str], list[_Conflict]] = {}
    threads = as_shared(sharing(context), context)
    doers: tuple[Doer, ...] = (*shared_by(context), *threads)
    for one, other in combinations(doers, 2):
        for owner, conflict in _of_pair(one, other, context):
            by_attribute.setdefault((owner, conflict.first.access.name), []).append(conflict)
    for thread in threads:
        node = node_of(thread, context)
        if node is not None and repeats_freely(thread, context):
            for conflict in _of_two_alike(thread):
                by_attribute.setdefault((node, conflict.first.access.name), []).append(conflict)
    return tuple(_joined(by_attribute))


def races_across(pairs: Iterable[tuple[Doer, Doer]]) -> Iterator[Race]:
    """Races of doers whose executors run at the same time, each on a thread of its own."""
    by_attribute: dict[tuple[str, str], list[_Conflict]] = {}
    for one, other in pairs:
        if _share_data(one, other):
            for conflict in _at_once(one, other, Overlap(), None):
                by_attribute.setdefault(('', conflict.first.access.name), []).append(conflict)
    yield from _joined(by_attribute)


def _of_pair(one: Doer, other: Doer, context: Context) -> Iterator[tuple[str, _Conflict]]:
    """What two disturb each other by; of two nodes only what is no part of a node."""
    nodes = node_of(one, context), node_of(other, context)
    if None in nodes or not _share_data(one, other):
        return
    if nodes[0] != nodes[1]:
        classes = node_classes((context.unit,))
        one, other = shared_part(one, classes), shared_part(other, classes)
    of_one = nodes[0] if nodes[0] == nodes[1] else None
    for conflict in _conflicts(one, other, context):
        yield of_one or '', conflict


def _joined(by_attribute: Mapping[tuple[str, str], list[_Conflict]]) -> Iterator[Race]:
    alike: dict[tuple[RaceKind, bool, str, frozenset[str]], list[Race]] = {}
    for (_, name), conflicts in by_attribute.items():
        race = _race(name, conflicts)
        others = frozenset(use.doer.name for use in race.others)
        key = (race.kind, race.is_flag, race.first.doer.name, others)
        alike.setdefault(key, []).append(race)
    yield from map(_join, alike.values())


def _join(races: list[Race]) -> Race:
    ordered = sorted(races, key=lambda race: race.first.place)
    return replace(ordered[0], names=tuple(name for race in ordered for name in race.names))


def _conflicts(one: Doer, other: Doer, context: Context) -> Iterator[_Conflict]:
    if not _share_data(one, other):
        return
    together: Overlap | None = None
    if isinstance(one, Callback) and isinstance(other, Callback):
        together = overlap(one, other, context)
        if together is None:
            yield from _over_awaits(one, other, context)
        one, other = (
            happens_before.meeting(one, other, context),
            happens_before.meeting(other, one, context),
        )
    elif (meeting := beside(one, other, context)) is not None:
        if _spins(one) or _spins(other):
            server, callback = meeting if _spins(one) else reversed(meeting)
            yield from _over_spins(server, callback, context)
            return
        together, (one, other) = Overlap(), meeting
    if together is not None:
        yield from _at_once(one, other, together, context)


def _share_data(one: Doer, other: Doer) -> bool:
    written = (writes_of(one).keys(), writes_of(other).keys())
    read = (reads_of(one).keys(), reads_of(other).keys())
    torn = {piece.name for piece in one.pieces} & {piece.name for piece in other.pieces}
    return bool(torn) or not (
        written[0].isdisjoint(written[1])
        and written[0].isdisjoint(read[1])
        and written[1].isdisjoint(read[0])
    )


def _of_two_alike(thread: Activity) -> Iterator[_Conflict]:
    """What two threads that run the same lose; that both store the same is no matter."""
    for conflict in _at_once(thread, thread, Overlap(), None):
        if conflict.kind in LOSING:
            yield conflict


def _at_once(
    one: Doer, other: Doer, together: Overlap, context: Context | None
) -> Iterator[_Conflict]:
    written = {access.name for access in one.writes} & {access.name for access in other.writes}
    others = [(RaceKind.CHANGED_IN_LOOP, *pair) for pair in changed_in_loop(one, other)]
    others += [(RaceKind.EMPTIED, *pair) for pair in emptied(one, other)]
    others += [(RaceKind.SHRUNK_IN_LOOP, *pair) for pair in shrunk_in_loop(one, other)]
    others += [(RaceKind.TAKEN, *pair) for pair in taken_in_between(one, other)]
    others += [(RaceKind.GONE, *pair) for pair in gone_in_between(one, other)]
    others += [(RaceKind.OVERWRITTEN, *pair) for pair in overwritten(one, other)]
    others += [(RaceKind.CLEARED_IN_USE, *pair) for pair in uses_cleared(one, other)]
    others += [(RaceKind.CLEARED_IN_USE, *pair) for pair in bare_uses_cleared(one, other)]
    others += [(RaceKind.TORN, *pair) for pair in torn_messages(one, other)]
    others += [(RaceKind.TORN_STATE, *pair) for pair in torn_states(one, other)]
    for name in sorted(written | {use.access.name for _, use, _ in others}):
        pairs = [
            (Use(one, a), Use(other, b))
            for a in writes_of(one).get(name, ())
            for b in writes_of(other).get(name, ())
            if not is_other_item(a, b)
            and not comes_before(a, one, other)
            and not comes_before(b, other, one)
        ]
        classified = [found for pair in pairs if (found := _classify(*pair, context)) is not None]
        classified += [found for found in others if found[1].access.name == name]
        if classified:
            kind, first, second = min(classified, key=lambda found: _WEIGHT[found[0]])
            yield _Conflict(kind, first, second, together.run)


def _over_awaits(one: Callback, other: Callback, context: Context) -> Iterator[_Conflict]:
    """What a coroutine read before it awaited, and writes or uses because of that afterwards."""
    for callback, rival in ((one, other), (other, one)):
        if interleaves(callback, rival, context):
            pairs = (
                (Use(callback, a), Use(rival, b)) for a in callback.writes for b in rival.writes
            )
            for first, second in pairs:
                if first.access.name == second.access.name and _is_stale(first, second, context):
                    yield _Conflict(RaceKind.CHECK_THEN_ACT, first, second, None)
            for reader, writer in torn_states(callback, rival, pauses=callback):
                yield _Conflict(RaceKind.TORN_STATE, reader, writer, None)


def _spins(doer: Doer) -> tuple[Act, ...]:
    """Where it runs the callbacks itself, one by one; they come in nowhere else."""
    return doer.spins if isinstance(doer, Activity) else ()


def _over_spins(server: Doer, callback: Doer, context: Context) -> Iterator[_Conflict]:
    """What ``main`` has read before it lets callbacks run, and relies on afterwards."""
    begun = min(steps(spin) for spin in _spins(server))
    pairs = [
        (RaceKind.CHECK_THEN_ACT, Use(server, a), Use(callback, b))
        for a in server.writes
        for b in writes_of(callback).get(a.name, ())
        if not is_other_item(a, b)
        and not changes_nothing(Use(server, a), Use(callback, b), context)
    ]
    found = [pair for pair in pairs if _is_read_before_spin(*pair[1:])]
    found += [(RaceKind.CHANGED_IN_LOOP, *pair) for pair in changed_in_loop(server, callback)]
    cleared = [(RaceKind.CLEARED_IN_USE, *pair) for pair in uses_cleared(server, callback)]
    found += [each for each in cleared if begun < steps(each[1].access)]
    for kind, first, second in found:
        if first.doer is server:
            yield _Conflict(kind, first, second, None)


def _is_read_before_spin(first: Use, second: Use) -> bool:
    write = first.access
    return (write.rests or write.update) and any(
        is_read_before(read, spin, write)
        and not keep_apart(kept_between(read, write, first.doer), second.access.locks)
        for _, read in reads_of(first.doer).get(write.name, ())
        for spin in _spins(first.doer)
    )


def _is_stale(first: Use, second: Use, context: Context) -> bool:
    write, doer = first.access, first.doer
    read = read_acted_on(write, doer, second.access)
    if (
        read is None
        or is_other_item(write, second.access)
        or changes_nothing(first, second, context)
    ):
        return False
    awaits = (b for b in doer.blocking if kind_of(b) is WaitKind.AWAIT)
    over_await = any(steps(read) < steps(block) < steps(write) for block in awaits)
    return over_await and not keep_apart(kept_between(read, write, doer), second.access.locks)


def _classify(one: Use, other: Use, context: Context | None) -> tuple[RaceKind, Use, Use] | None:
    if keep_apart(one.access.locks, other.access.locks):
        return _classify_locked(one, other, context)
    for first, second in ((one, other), (other, one)):
        if first.access.update and not first.access.in_place and _may_be_lost(first, second):
            return RaceKind.LOST_UPDATE, first, second
    for first, second in ((one, other), (other, one)):
        if first.access.whole:
            continue
        is_wanted = read_acted_on(first.access, first.doer, second.access) is not None
        is_wanted = is_wanted or (first.access.rests and not first.access.in_place)
        is_wanted = is_wanted or _is_old_item(first, second)
        is_wanted = is_wanted and not changes_nothing(first, second, context)
        if is_wanted and _is_read_before(first, second):
            return RaceKind.CHECK_THEN_ACT, first, second
    for first, second in ((one, other), (other, one)):
        is_wanted = first.access.in_place and not leaves_enough(first, second)
        if is_wanted and _is_read_before(first, second) and first.access.rests:
            return RaceKind.CHECK_THEN_CHANGE, first, second
    for first, second in ((one, other), (other, one)):
        if first.access.whole:
            return RaceKind.WHOLE_UPDATE, first, second
    if one.access.in_place and other.access.in_place:
        return None
    if changes_nothing(one, other, context) or changes_nothing(other, one, context):
        return None
    if store_alike(one, other):
        return None
    return RaceKind.LAST_WRITE_WINS, one, other


def _may_be_lost(update: Use, rival: Use) -> bool:
    """
    Whether another write may meet the update in the middle, or wipe it out.

    So does one that has read it before: ``print(self.n); self.n = 0``.
    """
    is_whole = update.access.whole
    return not is_whole or (not rival.access.whole and _is_read_before(rival, update))


def _classify_locked(
    one: Use, other: Use, context: Context | None
) -> tuple[RaceKind, Use, Use] | None:
    """A lock helps only if it is held from the read to the write that is based on it."""
    for first, second in ((one, other), (other, one)):
        write = first.access
        read = read_acted_on(write, first.doer, second.access)
        if changes_nothing(first, second, context):
            continue
        if read is not None and not keep_apart(
            kept_between(read, write, first.doer), second.access.locks
        ):
            return RaceKind.CHECK_THEN_ACT, first, second
    return None


def _is_old_item(first: Use, second: Use) -> bool:
    """Whether an item gets what was computed from itself, and the other stores the same one."""
    write = first.access
    return (
        write.in_place
        and write.chosen
        and is_same_item(write, second.access)
        and any(is_same_item(read, write) for _, read in reads_of(first.doer).get(write.name, ()))
    )


def _is_of_threads(*uses: Use) -> bool:
    return any(isinstance(use.doer, Activity) for use in uses)


def _is_read_before(first: Use, second: Use) -> bool:
    """True when ``first``'s callback also reads the attribute, without a lock of ``second``'s."""
    write = first.access
    end, changed_at = steps(write), _changed_at(first.doer)
    return any(
        not is_other_item(read, second.access)
        and (at < end or (write.in_place and is_operand(read, write)))
        and at not in changed_at
        and not keep_apart(read.locks, second.access.locks)
        for at, read in reads_of(first.doer).get(write.name, ())
    )


@once
def _changed_at(doer: Doer) -> frozenset[tuple[Place, ...]]:
    return frozenset(steps(write) for write in doer.writes if write.in_place)


def _is_flag(conflict: _Conflict) -> bool:
    """A thread and another test a flag and store a constant: no value is computed from it."""
    return conflict.first.access.constant and _is_of_threads(conflict.first, conflict.other)


def _find_the_same(conflict: _Conflict) -> bool:
    """Both act because of the same answer to a test, as two that find a place free."""
    found = conflict.first.access.found
    return found is not None and found == conflict.other.access.found


def _race(name: str, conflicts: list[_Conflict]) -> Race:
    worst = min(conflicts, key=lambda each: (_WEIGHT[each.kind], not _find_the_same(each)))
    first = worst.first.doer.name
    shown = [each for each in conflicts if each.kind is worst.kind or worst.kind not in _OWN_HARM]
    uses = [
        use
        for conflict in shown
        if first in (conflict.first.doer.name, conflict.other.doer.name)
        for use in (conflict.first, conflict.other)
    ]
    others = {use.doer.name: use for use in reversed(uses)}
    others.pop(first, None)
    order = dict.fromkeys(use.doer.name for use in uses)
    return Race(
        names=(name,),
        kind=worst.kind,
        first=worst.first,
        others=tuple(others[doer] for doer in order if doer in others) or (worst.other,),
        run=worst.run or next((c.run for c in conflicts if c.run), None),
        is_flag=all(_is_flag(conflict) for conflict in conflicts if conflict.kind is worst.kind),
    )


_WEIGHT = {kind: weight for weight, kind in enumerate(RaceKind)}
