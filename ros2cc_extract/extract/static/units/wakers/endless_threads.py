"""Threads in a loop that never ends, or nobody knows when, which others wait for."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ros2cc_extract.extract.static.concurrency.machine.state import ActivityState
from ros2cc_extract.extract.static.concurrency.machine.wake_operations import (
    DataRef,
    ResourceRef,
    Waking,
)
from ros2cc_extract.extract.static.concurrency.waits.uncalled_wakers import (
    data_is_written_elsewhere,
    uncalled_wakers,
)
from ros2cc_extract.extract.static.libraries.rclpy.machine.state import EntityState, RosWorld
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.machine.recorded_effects import way_of
from ros2cc_extract.extract.static.units.wakers.operations import comes_last, wakings_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import ENDLESS_LOOP, POLLING_LOOP, WORKING_LOOP, Blocking
from ros2cc_extract.spec.model import ActivityKind

_NOTED = frozenset([ENDLESS_LOOP, POLLING_LOOP, WORKING_LOOP])
"""Loops of which it is known what ends them."""


def never_comes(waking: Waking, waiting: object) -> bool:
    """Whether it is the end of a thread that never ends, whatever happens to rclpy."""
    thread = _endless(waking, waiting)
    return thread is not None and thread.endless is not None


def why_no_end(wakings: Iterable[Waking], waiting: object) -> Unknown | None:
    """Why a thread may not end while the program runs and others wait for its end."""
    threads = (_endless(waking, waiting) for waking in wakings)
    thread = next((each for each in threads if each is not None), None)
    if thread is None:
        return None
    return Unknown(
        'the loop of the thread ends only by an error or with the program', thread.place
    )


def _endless(waking: Waking, waiting: object) -> ActivityState | None:
    """
    The thread whose end it is, if that loops and others wait for it.

    ``main`` waits to keep the program running; ``threads_at_exit.py`` reports what never ends.
    """
    is_main = isinstance(waiting, ActivityState) and waiting.kind is ActivityKind.MAIN
    if is_main or waking.word is not Word.END or not isinstance(waking.by, ActivityState):
        return None
    return waking.by if waking.by.loops and waking.by is not waiting else None


def unknown_rounds(world: RosWorld) -> Mapping[int, Unknown]:
    """
    Threads that do something for others in a loop of which nobody knows how many rounds it has.

    They may go on as long as others wait, as a reader that ends with the input does, or be over.
    """
    found: dict[int, Unknown] = {}
    for waking in (each for wakings in world.wakings.values() for each in wakings):
        by = waking.by
        if waking.in_loop and isinstance(by, ActivityState) and not _is_known(by):
            reason = 'how many rounds the loop around it has is not known'
            found.setdefault(id(by), Unknown(reason, waking.place))
    for thread in world.activities:
        again = next((start for start in thread.starts if start.by is thread), None)
        if starts_itself(thread) and again is not None and again.conditional:
            found[id(thread)] = Unknown(
                'a branch decides whether it starts itself again', again.place
            )
    return found


def starts_itself(thread: ActivityState) -> bool:
    """Whether the set-up starts it, and then it itself, as a timer that is armed again."""
    by = [start.by for start in thread.starts]
    return thread in by and None in by


def why_uneven(wakings: Iterable[Waking], rounds: Mapping[int, Unknown]) -> Unknown | None:
    """
    Why a thread of unknown ``rounds`` gives in each of them another number than in the first.

    It waits in front of the loop, or behind it, for what it takes in each round as well.
    """
    for waking in wakings:
        by = waking.by
        if waking.in_loop and isinstance(by, ActivityState) and id(by) in rounds:
            ways = {way_of(block) for block in by.effects.blocking if block.seconds is None}
            if ways - by.effects.looped:
                return rounds[id(by)]
    return None


def may_not_come(
    waking: Waking,
    doer: EntityState | ActivityState,
    rounds: Mapping[int, Unknown],
    *,
    stays: bool,
) -> bool:
    """
    Whether the thread that does it may be over, or was not started.

    :param stays: what is done once is done for good; else it may be one of the ``rounds``.
    """
    by = waking.by
    if not isinstance(by, ActivityState) or waking.word is Word.END:
        return False
    # A branch of the set-up skips the thread, and not who waits for it.
    is_of_set_up = bool(by.starts) and all(start.by is None for start in by.starts)
    is_skipped = is_of_set_up and by.path != doer.path[: len(by.path)]
    return is_skipped or (not stays and id(by) in rounds)


def may_be_over(doer: object, write: object) -> bool:
    """Whether a thread does a ``write``, by name and place, an unknown number of times."""
    if not isinstance(doer, ActivityState) or write not in doer.effects.looped:
        return False
    return not _is_known(doer)


def is_never_left(waking: Waking, world: RosWorld, is_written: Callable[[DataRef], bool]) -> bool:
    """
    Whether branches skip it only where they end the loop of its thread, which goes on for good.

    :param is_written: whether callbacks or threads write data.
    """
    by = waking.by
    if not isinstance(by, ActivityState) or not waking.left:
        return False
    loops = [
        block
        for block in by.effects.blocking
        if block.call == WORKING_LOOP and waking.left <= by.effects.exits.get(block.source, set())
    ]
    return bool(loops) and not any(_may_end(loop, world, is_written) for loop in loops)


def _may_end(loop: Blocking, world: RosWorld, is_written: Callable[[DataRef], bool]) -> bool:
    on, queue = loop.on, loop.resource
    if isinstance(on, DataRef):
        is_open = data_is_written_elsewhere(world, on.names) is not None
        return loop.seconds is not None or is_open or is_written(on)
    if not isinstance(queue, ResourceRef) or loop.seconds is not None:
        return True
    ends = [w for w in wakings_of(world, queue) if w.word in queue.ended_by]
    others = uncalled_wakers(world, str(queue), queue.ended_by, queue.made)
    is_open = others is not None or queue.number in world.given
    return is_open or any(not comes_last(waking, world) for waking in ends)


def _is_known(thread: ActivityState) -> bool:
    loops = (block for block in thread.effects.blocking if block.call in _NOTED)
    return thread.loops or any(not isinstance(block.on, Unknown) for block in loops)
