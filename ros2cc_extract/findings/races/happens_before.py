"""
What a callback does before it asks for another one, or after it has waited for that.

A done-callback runs once for each time that it is added to a future (rclpy 7.1.6 and 9.1.2,
``task.py``, ``Future.add_done_callback``). Where one callback alone adds it, at one place, and
waits for it each time, none is left over when that callback begins, and when it goes on.
"""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Access, Act, Blocking
from ros2cc_extract.spec.model import Callback, EntityKind
from ros2cc_extract.spec.program_order import steps


def meeting(doer: Callback, other: Callback, context: Context) -> Callback:
    """``doer`` with the accesses that may coincide with those of ``other``."""
    if other.entity is not EntityKind.DONE_CALLBACK or context.exclusive_group(doer) is None:
        return doer
    begins = [(each, act) for each in context.doers for act in each.changes if _begins(act, other)]
    if len(begins) != 1 or begins[0][0].name != doer.name:
        return doer
    begin = steps(begins[0][1])
    ends = [steps(block) for block in doer.blocking if _waits_for(block, other, doer)]
    end = min((each for each in ends if begin < each), default=None)
    if end is None:
        return doer
    return replace(
        doer,
        reads=tuple(read for read in doer.reads if _is_between(begin, read, end)),
        writes=tuple(write for write in doer.writes if _is_between(begin, write, end)),
        pieces=tuple(piece for piece in doer.pieces if _is_between(begin, piece, end)),
    )


def _begins(act: Act, other: Callback) -> bool:
    return act.name == EntityKind.DONE_CALLBACK.value and act.source == other.source


def _waits_for(block: Blocking, other: Callback, doer: Callback) -> bool:
    is_sure = block.seconds is None and block.escapes is None and not block.conditional
    return is_sure and {waker.by for waker in block.wakers} - {doer.name} == {other.name}


def _is_between(begin: tuple[Place, ...], access: Access, end: tuple[Place, ...]) -> bool:
    """Whether it stands behind the one and not behind the other; a test has one line with both."""
    at = steps(access)
    if not at:
        return True
    on_line = at[:-1] == end[:-1] and (at[-1].file, at[-1].line) == (end[-1].file, end[-1].line)
    return begin < at and (at < end or on_line)
