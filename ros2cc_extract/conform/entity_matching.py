"""
Which callback of a specification each entity of a trace is, and how many one line has made.

What one line of a loop makes is one callback with a ``count``. A trace shows how many there were,
and which of them shared a group: then the unit that is compared has as many.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping
from dataclasses import field, replace

from ros2cc_extract.conform.trace import Subject, Trace
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.identifiers import mend
from ros2cc_extract.spec.model import Callback, EntityKind, Spec

_TASK_KINDS = {kind.value for kind in EntityKind if kind.is_task}
#: When the first and the last event about something were, by the clock.
Span = tuple[int, int]


def match(trace: Trace, executor: int, spec: Spec) -> dict[int, int]:
    """
    Find for each subject of an executor the place of its callback in ``spec``.

    By kind, node and name: function, topic or service. Subjects without one are left out.
    """
    return _match(trace, executor, spec).places


def with_copies(trace: Trace, executor: int, spec: Spec) -> tuple[Spec, frozenset[str]]:
    """
    Give ``spec`` as many callbacks of one line as the trace shows, in groups as it shows them.

    :return: the unit, and the names of those callbacks that now exist several times.
    """
    matched = _match(trace, executor, spec)
    copies = _Copies(trace, spec, matched.places)
    for number, place in matched.more.items():
        copies.add(number, place)
    return copies.unit(), copies.several


@dataclass(frozen=True)
class _Matched:
    """
    Places by the numbers of subjects.

    :param more: of further ones that a line of unknown or higher count has made.
    """

    places: dict[int, int] = field(default_factory=dict)
    more: dict[int, int] = field(default_factory=dict)


def _match(trace: Trace, executor: int, spec: Spec) -> _Matched:
    spans = _spans(trace)
    matched = _Matched()
    there: dict[int, list[Subject]] = defaultdict(list)
    for subject in trace.subjects.values():
        if subject.executor != executor:
            continue
        fitting = [p for p, c in enumerate(spec.callbacks) if _is_same(subject, c)]
        free = [p for p in fitting if _is_free(subject, there[p], spans)]
        # A free place first; else one that is over, as of a timer that is made anew for each shot.
        place = min(free, key=lambda p: bool(there[p]), default=None)
        if place is not None:
            there[place].append(subject)
            matched.places[subject.number] = place
            continue
        more = Counter(matched.more.values())
        several = (p for p in fitting if _may_be(1 + more[p], spec.callbacks[p]))
        place = next(several, None)
        if place is not None:
            matched.more[subject.number] = place
    return matched


def _may_be(more: int, callback: Callback) -> bool:
    """Whether a line makes so many more than one."""
    return isinstance(callback.count, Unknown) or more < callback.count


def _spans(trace: Trace) -> Mapping[int, Span]:
    spans: dict[int, Span] = {}
    for event in trace.events:
        first, _ = spans.get(event.subject, (event.clock_ns, 0))
        spans[event.subject] = first, event.clock_ns
    return spans


def _is_free(subject: Subject, there: list[Subject], spans: Mapping[int, Span]) -> bool:
    """Whether it may be the same callback as others: a task, or one when all others are over."""
    return subject.kind in _TASK_KINDS or all(
        one.group == subject.group and _are_apart(spans.get(one.number), spans.get(subject.number))
        for one in there
    )


def _are_apart(one: Span | None, other: Span | None) -> bool:
    return one is None or other is None or one[1] < other[0] or other[1] < one[0]


def _is_same(subject: Subject, callback: Callback) -> bool:
    kind = callback.entity
    if kind is None or kind.value != subject.kind:
        return False
    if subject.node and isinstance(callback.node, str) and subject.node != callback.node:
        return False
    if subject.key is not None and isinstance(callback.key, str) and subject.key != callback.key:
        return False
    if callback.function is None or subject.name == subject.key:
        return True
    return _last_parts(subject.name) == _last_parts(callback.function)


def _last_parts(name: str) -> str:
    """Source knows the module that a function is in, a live run does not."""
    return name.rpartition('.')[2]


@dataclass(frozen=True)
class _Copy:
    """
    One more callback of a line.

    :param number: of its subject, in the order of making.
    :param lap: which of the line's, from 1; 0 is the callback that is copied.
    """

    callback: Callback
    place: int
    number: int
    lap: int


class _Copies:
    """Callbacks and groups that are added to a unit."""

    def __init__(self, trace: Trace, spec: Spec, places: Mapping[int, int]) -> None:
        self._trace, self._spec = trace, spec
        self._numbers = {place: number for number, place in reversed([*places.items()])}
        self._taken = set(spec.names())
        self._copies: list[_Copy] = []
        self._groups = {group.name: group for group in spec.groups}
        self._group_of: dict[tuple[str, int | None], str] = {}
        for number, place in places.items():
            group = spec.callbacks[place].group
            self._group_of.setdefault((group, trace.subjects[number].group), group)

    @property
    def several(self) -> frozenset[str]:
        """Names of the callbacks that were copied."""
        return frozenset(self._spec.callbacks[copy.place].name for copy in self._copies)

    def add(self, number: int, place: int) -> None:
        """Add what a subject is: one more of the callback at ``place``."""
        subject, callback = self._trace.subjects[number], self._spec.callbacks[place]
        copied = replace(
            callback,
            name=self._new_name(callback.name),
            group=self._group(callback.group, subject.group),
            node=subject.node if isinstance(callback.node, Unknown) else callback.node,
        )
        lap = 1 + sum(copy.place == place for copy in self._copies)
        self._copies.append(_Copy(copied, place, number, lap))

    def _group(self, name: str, number: int | None) -> str:
        """Name the group: a line of a loop makes one, or one in each lap."""
        group = self._groups[name]
        is_one = group.count == 1 or all(known != name for known, _ in self._group_of)
        if is_one:
            self._group_of.setdefault((name, number), name)
        elif (name, number) not in self._group_of:
            copied = self._group_of[name, number] = self._new_name(name)
            self._groups[copied] = replace(group, name=copied, count=1)
        return self._group_of[name, number]

    def _new_name(self, name: str) -> str:
        new = mend(name, tuple(self._taken))
        self._taken.add(new)
        return new

    def unit(self) -> Spec:
        """The unit with all that was added, where the trace shows that it was made."""
        if not self._copies:
            return self._spec
        rows = [(self._numbers.get(p), c) for p, c in enumerate(self._spec.callbacks)]
        for copy in self._copies:
            before = (at for at, (number, _) in enumerate(rows) if number and number < copy.number)
            rows.insert(max(before, default=copy.place) + 1, (copy.number, self._relinked(copy)))
        return replace(
            self._spec,
            callbacks=tuple(replace(callback, count=1) for _, callback in rows),
            groups=tuple(self._groups.values()),
        )

    def _relinked(self, copy: _Copy) -> Callback:
        """What a copy waits for is what the same lap has made, where that was copied too."""
        names = {
            self._spec.callbacks[other.place].name: other.callback.name
            for other in self._copies
            if other.lap == copy.lap
        }
        blocking = (
            replace(
                block,
                on=names.get(block.on, block.on) if isinstance(block.on, str) else block.on,
                wakers=tuple(replace(w, by=names.get(w.by, w.by)) for w in block.wakers),
            )
            for block in copy.callback.blocking
        )
        return replace(copy.callback, blocking=tuple(blocking))
