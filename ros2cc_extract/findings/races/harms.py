"""What one doer breaks for another, other than by two writes or in a loop."""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.findings.races.critical_sections import (
    is_other_item,
    is_same_item,
    keep_apart,
    kept_between,
    read_for,
    reads_of,
    store_the_same,
    waits,
    writes_of,
)
from ros2cc_extract.findings.races.made_later import comes_before
from ros2cc_extract.findings.races.uses import Use, are_unordered, may_meet
from ros2cc_extract.spec.effects import Access
from ros2cc_extract.spec.model import Activity
from ros2cc_extract.spec.program_order import steps


def torn_messages(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """Objects that one takes as a whole while the other changes them piece by piece."""
    for sender, changer in ((one, other), (other, one)):
        yield from (
            (Use(sender, sent), Use(changer, change))
            for sent in sender.pieces
            for change in changer.pieces
            if sent.name == change.name
            and change.update
            and not sent.update
            and may_meet(Use(sender, sent), Use(changer, change))
        )


def uses_cleared(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """Objects that one tests and then uses, and the other sets to ``None`` in between."""
    for user, clearer in ((one, other), (other, one)):
        cleared = writes_of(clearer)
        for use in (*user.reads, *(write for write in user.writes if write.in_place)):
            clears = [write for write in cleared.get(use.name, ()) if write.clears]
            tested = read_for(use, user) if use.rests and clears else None
            if tested is not None:
                kept = kept_between(tested, use, user)
                yield from (
                    (Use(user, use), Use(clearer, write))
                    for write in clears
                    if not keep_apart(kept, write.locks)
                    and are_unordered(Use(user, use), Use(clearer, write))
                )


def bare_uses_cleared(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """
    Objects that one uses without any test, and a callback sets to ``None`` beside it.

    A thread that works until it is told to stop may have ended by then.
    """
    for user, clearer in ((one, other), (other, one)):
        is_over = isinstance(user, Activity) and user.loops is not True
        if isinstance(clearer, Activity) or is_over:
            continue
        cleared = writes_of(clearer)
        for use in (*user.reads, *(write for write in user.writes if write.in_place)):
            yield from (
                (Use(user, use), Use(clearer, write))
                for write in cleared.get(use.name, ())
                if use.bare and write.clears and may_meet(Use(user, use), Use(clearer, write))
            )


def torn_states(one: Doer, other: Doer, pauses: Doer | None = None) -> Iterator[tuple[Use, Use]]:
    """
    Attributes that one reads together while the other has written half of them.

    :param pauses: the only one of them whose thread others may have in between: while it waits.
    """
    for reader, writer in ((one, other), (other, one)):
        for last in writer.writes:
            first = written_before(last, writer)
            if first is not None:
                yield from _read_together(reader, writer, (first, last), pauses)


def written_before(last: Access, writer: Doer) -> Access | None:
    """The write of the attribute, or of another item, that stands before ``last``."""
    firsts = [
        each
        for each in writes_of(writer).get(last.joins or '', ())
        if each.in_place == last.in_place and (not last.in_place or is_other_item(each, last))
    ]
    before = [each for each in firsts if steps(each) < steps(last)]
    return max(before, key=steps, default=None)


def _read_together(
    reader: Doer, writer: Doer, writes: tuple[Access, Access], pauses: Doer | None
) -> Iterator[tuple[Use, Use]]:
    """The reads of both attributes, unless a lock is held over these and over the writes."""
    kept = kept_between(*writes, writer)
    found = [
        [
            read
            for _, read in reads_of(reader).get(write.name, ())
            if not read.compared and (not write.in_place or is_same_item(read, write))
        ]
        for write in writes
    ]
    if not all(found):
        return
    begin, end = sorted((reads[0] for reads in found), key=steps)
    if keep_apart(kept, kept_between(begin, end, reader)):
        return
    between = {writer.name: writes, reader.name: (begin, end)}
    if pauses is not None and not waits(*between[pauses.name], pauses):
        return
    for reads, write in zip(found, writes, strict=True):
        is_apart = comes_before(reads[0], reader, writer) or comes_before(write, writer, reader)
        if not is_apart:
            yield Use(reader, reads[0]), Use(writer, write)


def overwritten(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """
    What one has written and reads back after a wait, and the other writes in the same code.

    Reads by tests alone come last.
    """
    for reader, writer in ((one, other), (other, one)):
        for read in sorted(reader.reads, key=lambda read: read.asked):
            own = _last_write_before(read, reader)
            if own is None or read.compared or read.fresh or not waits(own, read, reader):
                continue
            kept = kept_between(own, read, reader)
            yield from (
                (Use(reader, read), Use(writer, write))
                for write in writes_of(writer).get(read.name, ())
                if write.source == own.source
                and not store_the_same((own, write))
                and not keep_apart(kept, write.locks)
                and are_unordered(Use(reader, read), Use(writer, write))
            )


def _last_write_before(read: Access, doer: Doer) -> Access | None:
    own = writes_of(doer).get(read.name, ())
    plain = [w for w in own if not w.in_place and not w.update and steps(w) < steps(read)]
    return max(plain, key=steps, default=None)
