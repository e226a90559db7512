"""
What there is to take at first: the value of a semaphore, the room in a bounded queue.

Code that gives back in each run what it takes uses up nothing, so the first number holds for
every run and the model can count it. Else it is a matter of how many runs there were.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wait_table import NO_ROW
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import ResourceRef, Waking
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState
from ros2cc_extract.extract.static.libraries.rclpy.machine.waits import WAITS
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import EffectLog, way_of
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import EntityKind

Doer = EntityState | ActivityState
# More is not counted: a model of so many runs could not use it up.
_COUNTED = 8


def counted(
    raw: Blocking, initial: int | None, doers: Sequence[Doer], given: Sequence[Waking]
) -> int:
    """How many waits like ``raw`` end by themselves in every run; 0 where that is not known."""
    takers = [doer for doer in doers if any(_takes(raw, doer))]
    return few(initial) if all(_gives_back(raw, doer, given) for doer in takers) else 0


def few(initial: int | None) -> int:
    """So many waits end by themselves, where a model may use them up; 0 if there are too many."""
    return initial if initial is not None and 0 < initial <= _COUNTED else 0


def has_room(reference: ResourceRef, wakings: Sequence[Waking]) -> bool:
    """
    Whether it is the room in a queue that each run makes anew, and enough for all that is put in.

    Only done-callbacks put into it, each once for a run of the callback that makes the queue.
    """
    puts = [waking for waking in wakings if waking.word is Word.PUT]
    is_once = all(not (each.in_loop or each.repeats) and _is_of_one_run(each.by) for each in puts)
    is_room = reference.is_own and reference.ended_by == {Word.GET}
    return is_room and is_once and len(puts) <= (reference.initial or 0)


def _is_of_one_run(doer: object) -> bool:
    is_done = isinstance(doer, EntityState) and doer.kind is EntityKind.DONE_CALLBACK
    return is_done and doer.count == 1  # type: ignore[attr-defined]


def is_plain_lock(
    raw: Blocking, doer: Doer, doers: Sequence[Doer], given: Sequence[Waking]
) -> bool:
    """
    Whether a semaphore is only taken as a lock.

    All code that takes it gives it back, waits for nothing meanwhile, and does not take it twice.
    """
    takers = [each for each in doers if any(_takes(raw, each))]
    return any(each is doer for each in takers) and all(
        len(list(_takes(raw, each))) == 1
        and all(block.times == 1 for block in _takes(raw, each))
        and _gives_on_all_ways(raw, each, given)
        and not _waits_meanwhile(raw, each, given)
        for each in takers
    )


def _gives_on_all_ways(raw: Blocking, doer: Doer, given: Sequence[Waking]) -> bool:
    """
    Whether it gives back what it takes.

    Several branches that do are taken for all that there are, and what it perhaps takes it gives
    back where it has it.
    """
    own = [waking for waking in given if waking.by is doer]
    may_have_none = all(b.conditional or b.seconds is not None for b in _takes(raw, doer))
    is_sure = len(own) > 1 or any(not waking.conditional for waking in own)
    return bool(own) and (is_sure or may_have_none)


def _takes(raw: Blocking, doer: Doer) -> Iterator[Blocking]:
    """The waits of ``doer`` for the same thing."""
    for block in (doer.effects or EffectLog()).blocking:
        if block.call == raw.call and _number(block) == _number(raw):
            yield block


def _number(block: Blocking) -> int | None:
    return block.resource.number if isinstance(block.resource, ResourceRef) else None


def _gives_back(raw: Blocking, doer: Doer, given: Sequence[Waking]) -> bool:
    taken = list(_takes(raw, doer))
    own = [waking for waking in given if waking.by is doer]
    is_sure = not any(block.times > 1 or block.seconds is not None for block in taken)
    return is_sure and len(own) >= len(taken) and not any(w.conditional for w in own)


def _waits_meanwhile(raw: Blocking, doer: Doer, given: Sequence[Waking]) -> bool:
    """Whether ``doer`` waits for something else before it gives back what it took."""
    blocks = (doer.effects or EffectLog()).blocking
    ways = [way_of(block) for block in blocks]
    last = [ways.index(w.behind) for w in given if w.by is doer and w.behind in ways]
    mine = [number for number, block in enumerate(blocks) if _number(block) == _number(raw)]
    held = blocks[mine[0] + 1 : max(last, default=-1) + 1] if mine else []
    return any(
        block.seconds is None and WAITS.get(block.call, NO_ROW).ended_by and block.call != raw.call
        for block in held
    )
