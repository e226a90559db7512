"""
Collections whose items others add or take meanwhile.

A loop over a dictionary, set or deque notices that its size changes. One over a list does not;
but a callback that goes over what has come and then empties the list loses what others put in
between its last look and that. Code that counts through the indices, or has found that there is an
item, or has a key from there, fails where others have taken it out.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.findings.races.critical_sections import (
    is_other_item,
    is_same_item,
    keep_apart,
    kept_between,
    read_for,
    waits,
    writes_of,
)
from ros2cc_extract.findings.races.uses import Use, are_unordered, may_meet
from ros2cc_extract.spec.effects import (
    ADDS,
    BY_INDEX,
    BY_KEY,
    EMPTIES,
    FILLS,
    TAKES,
    TAKES_ANY,
    TAKES_NEXT,
    Access,
)
from ros2cc_extract.spec.program_order import steps

_NOTICING = frozenset({'dict', 'set', 'deque'})
_FEWER = frozenset({TAKES, TAKES_ANY, TAKES_NEXT, EMPTIES})
_TAKING = _FEWER - {EMPTIES}
_MORE = frozenset({ADDS, FILLS})
_RIVALS = {TAKES_ANY: _FEWER, TAKES_NEXT: _FEWER, FILLS: _MORE}
"""What brings that about in which an operation fails, or waits."""


def changed_in_loop(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """Loops of one over a collection that the other changes in place, without a common lock."""
    for looper, changer in ((one, other), (other, one)):
        for read in looper.reads:
            if read.iterates in _NOTICING:
                yield from (
                    (Use(looper, read), Use(changer, write))
                    for write in changer.writes
                    if write.name == read.name
                    and write.in_place
                    and not write.keeps_size
                    and may_meet(Use(looper, read), Use(changer, write))
                )


def emptied(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """Collections that one goes over and then empties, while the other puts something in."""
    for looper, giver in ((one, other), (other, one)):
        for clear in (write for write in looper.writes if write.moves == EMPTIES):
            looks = [
                read
                for read in looper.reads
                if read.name == clear.name and read.iterates and steps(read) < steps(clear)
            ]
            held = kept_between(looks[-1], clear, looper) if looks else ()
            yield from (
                (Use(looper, clear), Use(giver, write))
                for write in (giver.writes if looks else ())
                if write.name == clear.name
                and write.moves == ADDS
                and not keep_apart(held, write.locks)
                and are_unordered(Use(looper, clear), Use(giver, write))
            )


def shrunk_in_loop(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """Loops of one through the indices of a list from which the other takes items."""
    for looper, taker in ((one, other), (other, one)):
        for read in looper.reads:
            if read.iterates == BY_INDEX:
                yield from (
                    (Use(looper, read), Use(taker, write))
                    for write in taker.writes
                    if write.name == read.name
                    and write.moves in _FEWER
                    and may_meet(Use(looper, read), Use(taker, write))
                )


def taken_in_between(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """
    Items that one takes because it has found some and waited, while the other takes some.

    Or puts in because there was room. A queue may do others' work between a question and that.
    Who puts another collection in its place takes all that were found.
    """
    for finder, taker in ((one, other), (other, one)):
        for take in (write for write in finder.writes if write.moves in _RIVALS and write.rests):
            look = read_for(take, finder)
            if look is None or (take.moves == TAKES_ANY and not waits(look, take, finder)):
                continue
            rivals = _RIVALS[take.moves or '']
            held = kept_between(look, take, finder)
            yield from (
                (Use(finder, take), Use(taker, write))
                for write in taker.writes
                if write.name == take.name
                and (write.moves in rivals or is_replaced(take, write))
                and (take.item is None or not write.in_place or is_same_item(take, write))
                and not keep_apart(held, write.locks)
                and are_unordered(Use(finder, take), Use(taker, write))
            )


def is_replaced(take: Access, write: Access) -> bool:
    """Whether ``write`` puts another collection there, from which ``take`` then takes an item."""
    is_other = write.moves is None and not (write.in_place or write.clears)
    return take.moves == TAKES_ANY and is_other


def gone_in_between(one: Doer, other: Doer) -> Iterator[tuple[Use, Use]]:
    """
    Items that one has found and looks up again, while the other takes them out.

    Of a list only one that is emptied surely lacks what was found.
    """
    for finder, taker in ((one, other), (other, one)):
        taken = writes_of(taker)
        for use in (read for read in finder.reads if read.looks_up and read.name in taken):
            look = read_for(use, finder)
            rivals = _FEWER if use.looks_up == BY_KEY else (EMPTIES,)
            held = kept_between(look, use, finder) if look is not None else ()
            yield from (
                (Use(finder, use), Use(taker, write))
                for write in (taken[use.name] if look is not None else ())
                if write.moves in rivals
                and not is_other_item(use, write)
                and not keep_apart(held, write.locks)
                and are_unordered(Use(finder, use), Use(taker, write))
            )


def leaves_enough(first: Use, second: Use) -> bool:
    """
    Code that takes an item out because there is one finds one, if others only put items in.

    So does code that puts one in because there is room, if they only take some out.
    """
    mine, other = first.access.moves, second.access.moves
    if mine == FILLS:
        return other in _FEWER
    return mine in _TAKING and other in _MORE
