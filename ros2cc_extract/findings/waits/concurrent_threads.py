"""
What threads of the program's own and others may do at the same time.

No group and no executor keeps a thread from running beside a callback or another thread. What
keeps them apart is their order: a thread does nothing before its start and nothing after its
join. Where the order is not plain, nothing is claimed.
"""

from __future__ import annotations

from dataclasses import replace

from ros2cc_extract.findings.base.rule import Context, Doer
from ros2cc_extract.findings.waits.capacity import runs_once
from ros2cc_extract.findings.waits.overlap import overlap, overlaps_itself
from ros2cc_extract.findings.waits.waits import WaitKind, kind_of
from ros2cc_extract.findings.waits.workers import workers_of
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.effects import OUTSIDE, Access, Blocking, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, EntityKind
from ros2cc_extract.spec.program_order import steps


def sharing(context: Context) -> tuple[Activity, ...]:
    """
    The threads whose data others may see.

    Left out are processes, which have a memory of their own, threads that have ended before
    anything spins, and those that run one method: they may be those of different objects.
    """
    threads = [one for one in context.unit.activities if one.kind is not ActivityKind.PROCESS]
    texts = [(one.function, one.cls, one.kind) for one in threads]
    return tuple(
        one
        for one, text in zip(threads, texts, strict=True)
        if one.unresolved is None and not one.ends_first and texts.count(text) == 1
    )


def node_of(doer: Doer, context: Context) -> str | None:
    """The node whose data it sees; a thread of no node belongs to the only one."""
    if isinstance(doer.node, str):
        return doer.node
    is_free = isinstance(doer, Activity) and doer.node is None and len(context.unit.nodes) == 1
    return context.unit.nodes[0] if is_free else None


def beside(one: Doer, other: Doer, context: Context) -> tuple[Doer, Doer] | None:
    """Both with the accesses that may coincide; ``None`` where no thread is among them."""
    if isinstance(one, Activity):
        may = _may_coincide(one, other, context)
    else:
        may = isinstance(other, Activity) and _may_coincide(other, one, context)
    return (_meeting(one, other), _meeting(other, one)) if may else None


def repeats(thread: Activity) -> bool:
    """
    Whether several threads run it at once.

    Those of a pool may have to take turns, and those of timers follow each other.
    """
    is_several = isinstance(thread.count, Unknown) or thread.count > 1
    is_plain = thread.kind is ActivityKind.THREAD and not is_of_a_loop(thread)
    by_itself = any(start.by == thread.name for start in thread.starts)
    return is_several and is_plain and not by_itself and not thread.conditional


def leaves_behind(callback: Callback, thread: Activity) -> bool:
    """
    Whether each run of ``callback`` starts the thread, which the next run may find still at work.

    Where a branch leads to the start, that may be because the one before has ended.
    """
    starts = [start for start in thread.starts if start.by == callback.name]
    is_sure = any(not start.conditional and start.after is not None for start in starts)
    is_joined = any(_joins(block, thread) for block in callback.blocking)
    return is_sure and not is_joined and not runs_once(callback)


def repeats_freely(thread: Activity, context: Context) -> bool:
    """Whether several run at once; code that starts one and joins it has only one at a time."""
    holder = _holder(thread, context)
    if isinstance(holder, Callback):
        return repeats(thread) and overlaps_itself(holder, context)
    return holder is None and repeats(thread)


def _may_coincide(thread: Activity, other: Doer, context: Context) -> bool:
    if _wait_for_each_other(thread, other) or _are_alternatives(thread, other):
        return False
    if isinstance(other, Callback):
        is_open = isinstance(workers_of(context.unit.executor), Unknown)
        if is_open or _is_transition_of(other, thread, context):
            return False
    elif _take_turns(thread, other):
        return False
    frames = _frame(thread, context), _frame(other, context)
    if all(isinstance(frame, Callback) for frame in frames) and frames[0] != frames[1]:
        return overlap(*frames, context) is not None  # type: ignore[arg-type]
    return True


def _are_alternatives(thread: Activity, other: Doer) -> bool:
    """Two that branches may skip may be those of different branches."""
    if isinstance(other, Callback):
        return other.alternative is not None or (thread.conditional and other.conditional)
    return thread.conditional and other.conditional


def _take_turns(one: Activity, other: Activity) -> bool:
    """Tasks of one pool and coroutines of one loop may share a thread."""
    if one.kind is other.kind is ActivityKind.POOL:
        return True
    return (is_of_a_loop(one) and is_of_a_loop(other)) or _follow_each_other(one, other)


def is_of_a_loop(thread: Activity) -> bool:
    """Whether a loop runs it, which does all that it runs on one thread."""
    return thread.on_loop or any(kind_of(block) is WaitKind.AWAIT for block in thread.blocking)


def _follow_each_other(one: Activity, other: Activity) -> bool:
    """Threads of one starter may follow each other, where one is known to end the other's wait."""
    starters = {start.by for start in one.starts} & {start.by for start in other.starts}
    return bool(starters) or any(
        start.by in (one.name, other.name) for each in (one, other) for start in each.starts
    )


def _wait_for_each_other(one: Doer, other: Doer) -> bool:
    """Two that hand over to each other by signals go by turns."""
    return _waits_for(one, other) and _waits_for(other, one)


def _waits_for(one: Doer, other: Doer) -> bool:
    return any(waker.by == other.name for block in one.blocking for waker in block.wakers)


def _is_transition_of(callback: Callback, thread: Activity, context: Context) -> bool:
    """Transitions of a life-cycle node start and end its threads in an order of their own."""
    if callback.entity is not EntityKind.LIFECYCLE_SERVICE:
        return False
    starters = [context.by_name.get(start.by) for start in thread.starts]
    return any(each is not None and each.entity is callback.entity for each in starters)


def _frame(doer: Doer, context: Context) -> Doer:
    """The doer in whose run it runs from start to end; itself if nothing joins it."""
    seen = {doer.name}
    while isinstance(doer, Activity):
        holder = _holder(doer, context)
        if holder is None or holder.name in seen:
            return doer
        doer = holder
        seen.add(doer.name)
    return doer


def _holder(thread: Activity, context: Context) -> Doer | None:
    """The only doer that starts it, and waits for its end."""
    names = {start.by for start in thread.starts}
    everybody: tuple[Doer, ...] = (*context.unit.callbacks, *context.unit.activities)
    starters = [one for one in everybody if one.name in names]
    if len(names) != 1 or len(starters) != 1:
        return None
    return starters[0] if any(_joins(block, thread) for block in starters[0].blocking) else None


def _joins(block: Blocking, thread: Activity) -> bool:
    return any(waker.by == thread.name and waker.after is None for waker in block.wakers)


def _meeting(doer: Doer, other: Doer) -> Doer:
    """``doer`` with what it may do while ``other`` runs, or is about to."""
    starts = other.starts if isinstance(other, Activity) else ()
    starts = tuple(start for start in starts if start.by == doer.name)
    ends = [steps(block) for block in doer.blocking if _ends_before(block, doer, other)]
    over = min(ends, default=None)

    def is_beside(access: Access) -> bool:
        if starts and not any(_is_behind(access, start, doer) for start in starts):
            return False
        return over is None or not over < steps(access)

    return replace(
        doer,
        reads=tuple(read for read in doer.reads if is_beside(read)),
        writes=tuple(write for write in doer.writes if is_beside(write)),
        pieces=tuple(piece for piece in doer.pieces if is_beside(piece)),
    )


def _ends_before(block: Blocking, doer: Doer, other: Doer) -> bool:
    """
    Whether ``other`` has ended behind this wait; for ``main``, the thread that spins.

    What ``main`` waits for before it goes on comes before what it does then, as far as is known.
    """
    if isinstance(other, Activity):
        return _joins(block, other)
    is_main = isinstance(doer, Activity) and doer.kind is ActivityKind.MAIN
    if is_main and any(waker.by == other.name for waker in block.wakers):
        return True
    by_outside = any(waker.by == OUTSIDE for waker in block.wakers)
    return is_main and by_outside and block.call == 'Thread.join'


def _is_behind(access: Access, start: Waker, doer: Doer) -> bool:
    """Whether it stands behind the start in one function, that of ``doer`` itself."""
    begin = doer.source if doer.defined is None else doer.defined
    at = steps(access)[0] if steps(access) else None
    places: list[Place | None] = [begin, start.source, at]
    known = [place for place in places if place is not None]
    is_one_file = len(known) == len(places) and len({place.file for place in known}) == 1
    return is_one_file and known[0] < known[1] < known[2]
