"""
Loops over a collection that others change meanwhile.

A loop over a dictionary, set or deque notices that its size changes. One over a list does not;
but a callback that goes over what has come and then empties the list loses what others put in
between its last look and that.
"""

from __future__ import annotations

from collections.abc import Iterator

from ros2cc_extract.findings.base.rule import Doer
from ros2cc_extract.findings.races.critical_sections import keep_apart, kept_between
from ros2cc_extract.findings.races.uses import Use, may_meet
from ros2cc_extract.spec.effects import ADDS, EMPTIES
from ros2cc_extract.spec.program_order import steps

_NOTICING = frozenset({'dict', 'set', 'deque'})


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
                and may_meet(Use(looper, clear), Use(giver, write))
            )
