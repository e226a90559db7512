"""What a trace says about one unit, in the terms of its model: which callback did which step."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from enum import Enum

from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.spec.model import EntityKind, GroupType, Spec

#: A collecting thread looks at the group just before it reports; this long after its last step, it
#: may have slept in between (89 ms were seen on a machine with eight times its load).
ASLEEP_NS = 20_000_000
#: Until this time before its end a trace reports all that was made.
UNREPORTED_NS = 200_000_000


class Act(Enum):
    """A step of an executor that can be seen from outside; the value is its wording."""

    WAKE = 'wakes up'
    COLLECT = 'collects'
    ARRIVE = 'is made'
    BEGIN = 'starts'
    REFUSED = 'is refused'
    TAKE = 'takes its data'
    END = 'ends'
    SUSPEND = 'awaits'
    RESUME = 'goes on'
    PAUSE = 'ends or awaits'


@dataclass(frozen=True, kw_only=True)
class Observation:
    """
    One observed step.

    :param callback: place of the callback in the unit; ``None`` for a wake-up.
    :param earliest_ns: when it can have happened at the earliest: a wait may have been over
        long before it returned.
    :param found: what a wake-up has found ready, by place.
    :param takes: its data was seen to be taken in the same step.
    :param is_task: it runs outside every group, and goes on as it begins.
    :param has_arrived: that something arrived for it is an observation of its own.
    :param group: of a begin or an end the exclusive group that is closed or opened.
    """

    act: Act
    callback: int | None
    thread: int
    clock_ns: int
    earliest_ns: int
    found: frozenset[int] = frozenset()
    takes: bool = False
    is_task: bool = False
    has_arrived: bool = False
    group: str | None = None


_ACTS = {
    'collect': Act.COLLECT,
    'begin': Act.BEGIN,
    'refused': Act.REFUSED,
    'take': Act.TAKE,
    'end': Act.END,
    'suspend': Act.SUSPEND,
    'resume': Act.RESUME,
}
_ACTS_OF_TASKS = {
    'task': Act.ARRIVE,
    'run': Act.BEGIN,
    'pause': Act.PAUSE,
}
TASKS = (EntityKind.TASK, EntityKind.DONE_CALLBACK, EntityKind.ACTION_EXECUTE)
_TASK_KINDS = {kind.value for kind in TASKS}


def observe(trace: Trace, executor: int, places: Mapping[int, int]) -> tuple[Observation, ...]:
    """
    List what was observed of an executor and its callbacks, in the order of the clock.

    Waits after which nothing was collected, and hand-overs of what was collected, are left out.
    """
    rows = list(_observations(trace, executor, places))
    return tuple(_with_takes(_with_found(rows)))


def _observations(trace: Trace, executor: int, places: Mapping[int, int]) -> Iterator[Observation]:
    waits_since: dict[int, int] = {}
    before: dict[int, int] = {}
    for event in trace.events:
        if event.subject == executor:
            if event.name == 'wait>':
                waits_since[event.thread] = event.clock_ns
            elif event.name == 'wait<':
                since = waits_since.get(event.thread, event.clock_ns)
                before[event.thread] = event.clock_ns
                yield _observation(Act.WAKE, None, event, since)
        elif event.subject in places:
            subject = trace.subjects[event.subject]
            act = _act(event, subject)
            is_task = _is_task(subject)
            if act is not None:
                last = before.get(event.thread, 0)
                since = last if _is_late(act, subject, event.clock_ns - last) else event.clock_ns
                before[event.thread] = event.clock_ns
                seen = _observation(act, places[event.subject], event, since)
                yield replace(seen, is_task=is_task)


def _is_late(act: Act, subject: Subject, silence_ns: int) -> bool:
    """
    Return whether a step may have happened at any time since the one before it in its thread.

    What is made is reported afterwards, and may have been served by then. So is an answer: it
    wakes the code that awaits it before the client's own handler ends. A coroutine asks before it
    awaits: what it asked for may arrive in between (40 ms were seen under load).
    """
    is_answer = act is Act.END and subject.kind == EntityKind.CLIENT.value
    is_asleep = act is Act.COLLECT and silence_ns >= ASLEEP_NS
    return act in (Act.ARRIVE, Act.SUSPEND) or is_answer or is_asleep


def _act(event: Event, subject: Subject) -> Act | None:
    if event.name == 'take' and subject.kind == EntityKind.GUARD_CONDITION.value:
        return None  # there is nothing to take
    return (_ACTS_OF_TASKS if _is_task(subject) else _ACTS).get(event.name)


def _is_task(subject: Subject) -> bool:
    return subject.kind in _TASK_KINDS


def _observation(act: Act, callback: int | None, event: Event, earliest: int) -> Observation:
    return Observation(
        act=act,
        callback=callback,
        thread=event.thread,
        clock_ns=event.clock_ns,
        earliest_ns=earliest,
    )


def _with_found(rows: Sequence[Observation]) -> Iterator[Observation]:
    """Say of each wake-up what was collected until the next, in the same thread."""
    found: dict[int, set[int]] = {}
    kept: list[Observation] = []
    for row in reversed(rows):
        if row.act is Act.COLLECT and row.callback is not None:
            found.setdefault(row.thread, set()).add(row.callback)
        if row.act is Act.WAKE:
            collected = found.pop(row.thread, set())
            if not collected:
                continue
            row = replace(row, found=frozenset(collected))
        kept.append(row)
    yield from reversed(kept)


def _with_takes(rows: Iterator[Observation]) -> Iterator[Observation]:
    """Join each take with the begin before it in the same thread: one step of the model."""
    begun: dict[int, int] = {}
    kept: list[Observation] = []
    for row in rows:
        before = begun.pop(row.thread, None)
        if row.act is Act.TAKE and before is not None and kept[before].callback == row.callback:
            kept[before] = replace(kept[before], takes=True)
            continue
        if row.act is Act.BEGIN:
            begun[row.thread] = len(kept)
        kept.append(row)
    yield from kept


def with_unreported_tasks(seen: Sequence[Observation], spec: Spec) -> tuple[Observation, ...]:
    """
    Add tasks that have run, if the trace ends before it reports that they were made.

    Their maker reports it afterwards. What is no coroutine has begun once for each time.
    """
    if not seen:
        return ()
    end_ns = seen[-1].clock_ns + 1
    times = Counter((each.callback, each.act) for each in seen if each.is_task)
    untold = tuple(
        Observation(
            act=Act.ARRIVE,
            callback=place,
            thread=-1,
            clock_ns=end_ns,
            earliest_ns=end_ns - UNREPORTED_NS,
            is_task=True,
        )
        for place, callback in enumerate(spec.callbacks)
        if not callback.coroutine
        for _ in range(times[place, Act.BEGIN] - times[place, Act.ARRIVE])
    )
    return (*seen, *untold)


def with_groups(seen: Sequence[Observation], spec: Spec) -> tuple[Observation, ...]:
    """
    Name the exclusive groups that a begin closes and an end opens.

    The hook reads the clock after a group let a callback begin, and before it learns of an end
    (``extract/live/hook/groups.py``): by the clock these never overlap where the group is kept.
    """
    exclusive = {group.name for group in spec.groups if group.type is GroupType.EXCLUSIVE}
    group_of = {
        place: callback.group
        for place, callback in enumerate(spec.callbacks)
        if callback.group in exclusive and not callback.groupless
    }
    return tuple(
        replace(each, group=group_of.get(each.callback))
        if each.callback is not None and each.act in (Act.BEGIN, Act.END)
        else each
        for each in seen
    )
