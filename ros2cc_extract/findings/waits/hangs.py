"""
What of a run shows that callbacks wait forever: how they get there, and what it ends in.

A run that refutes *it always ends* goes on until nothing moves any more, so that all else that
could happen has happened; most of it has no part in the wait.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Evidence, Moment

_AWAIT, _GO_ON, _WAKE, _END = 'await', 'go_on', 'wake', 'end'
_ARRIVALS = ('due', 'arrival')
_SIGNALS = ('signal', 'silence')
_OF_RUNS = ('start', _END)
#: What others do for a wait while it lasts.
_PARTS = (*_ARRIVALS, *_OF_RUNS, *_SIGNALS)


@dataclass(frozen=True)
class Standstill:
    """
    A wait that has not ended at the end of a run.

    :param event: its begin.
    :param since: index of the moment in which it began.
    """

    event: Event
    since: int

    @property
    def who(self) -> str:
        """Name of the callback that waits."""
        return self.event.who or ''

    @property
    def needed(self) -> str:
        """What ends it, in words; ``enders`` are their names."""
        return self.event.awaited or ''

    @property
    def thread(self) -> str | None:
        """That it holds; ``None`` for an ``await``, and where no executor has it."""
        return None if self._is_await else self.event.thread

    @property
    def spins(self) -> bool:
        """True where it serves others on that thread meanwhile."""
        return self.event.is_spin

    @property
    def is_for_lock(self) -> bool:
        """True where ``needed`` holds the lock that is waited for."""
        return self.event.is_for_lock

    @property
    def enders(self) -> tuple[str, ...]:
        """Names of those that can end it."""
        return self.event.enders

    @property
    def wait(self) -> int | None:
        """Which of the waits of ``who`` in the model."""
        return self.event.wait

    @property
    def _is_await(self) -> bool:
        return self.event.kind == _AWAIT

    def said(self, names: Mapping[str, str]) -> str:
        """Say what waits for what, with words for names of the model."""
        who, needed = names.get(self.who, self.who), self.event.awaited_in(names)
        if self._is_await:
            return f'{who} awaits {needed}'
        verb = 'spins' if self.spins else 'waits'
        on_thread = f' on {self.thread}' if self.thread is not None else ''
        what = f'the lock of {needed}' if self.is_for_lock else needed
        return f'{who} {verb}{on_thread} for {what}'


def show_hang(
    run: Evidence,
    about: Collection[str],
    groups: Mapping[str, str],
    threads: Collection[str],
    names: Mapping[str, str] = MappingProxyType({}),
) -> Evidence:
    """
    Leave out of a run what has no part in the waits of ``about``, and say what it ends in.

    :param about: names of the callbacks that wait, and of those they wait for.
    :param groups: the mutually exclusive group of each callback that is in one.
    :param threads: all that the executor has.
    :param names: words for names of the model.
    :return: the run as it was where it does not end in such a wait.
    """
    standing = open_waits(run.moments)
    held = {wait.thread for wait in standing if not wait.spins}
    is_full = held >= set(threads)
    waits = standing if is_full else _concerned(standing, about, groups)
    if not waits:
        return run
    kept_moments = sorted(
        set(
            _kept_moments(
                run.moments, waits, {*about, *(name for wait in waits for name in wait.enders)}
            )
        )
    )
    return replace(
        run,
        moments=tuple(_renumbered(run.moments, kept_moments)),
        left_out=len(run.moments) - len(kept_moments),
        closing=_closing(waits, groups, names, is_full=is_full),
    )


def open_waits(moments: Sequence[Moment]) -> list[Standstill]:
    """Give the waits that have not ended at the end of a run, in the order of their begin."""
    waits: list[Standstill] = []
    for index, event in _events(moments):
        if event.is_wait and event.who is not None and event.awaited is not None:
            waits.append(Standstill(event, index))
        elif event.kind == _GO_ON:
            over = next((wait for wait in waits if wait.who == event.who), None)
            waits = [wait for wait in waits if wait is not over]
    return waits


def _concerned(
    waits: Sequence[Standstill], about: Collection[str], groups: Mapping[str, str]
) -> list[Standstill]:
    """Those of ``about``, of what they wait for, and of what keeps the groups of these closed."""
    names = set(about)
    while True:
        closed = {groups[name] for name in names if name in groups}
        found = [w for w in waits if w.who in names or groups.get(w.who) in closed]
        wider = names | {name for wait in found for name in (wait.who, *wait.enders)}
        if wider == names:
            return found
        names = wider


def _kept_moments(
    moments: Sequence[Moment], waits: Sequence[Standstill], names: Collection[str]
) -> Iterator[int]:
    """Of the waiting callbacks the run that waits; of others what they do for it meanwhile."""
    for wait in waits:
        yield from _given_too_early(moments[: wait.since], wait)
    waiting = {wait.who: wait.since for wait in waits}
    begin = {who: _begin(moments, who, since) for who, since in waiting.items()}
    first = min(waiting.values())
    last_wake: int | None = None
    for index, event in _events(moments):
        if event.kind == _WAKE:
            last_wake = index
        who = next((name for name in event.mentions if name in waiting), None)
        if who is not None:
            if begin[who] <= index <= waiting[who]:
                yield index
                if last_wake is not None and event.kind not in _ARRIVALS:
                    yield last_wake
                    last_wake = None
        elif index > first and event.kind in _PARTS and event.who in names:
            yield index


def _given_too_early(before: Sequence[Moment], wait: Standstill) -> Iterator[int]:
    """Where what could end a wait has done so before it began, and what has used that up."""
    begin = _begin(before, wait.who, wait.since)
    of_enders, earlier, is_given = [], [], False
    for index, event in _events(before):
        if event.who in wait.enders and event.kind in (*_OF_RUNS, *_SIGNALS):
            of_enders.append(index)
            is_given |= event.kind in (*_SIGNALS, _END)
        elif event.who == wait.who and event.kind in _OF_RUNS and index < begin:
            earlier.append(index)
    if is_given:
        yield from (*of_enders, *earlier)


def _begin(moments: Sequence[Moment], who: str, since: int) -> int:
    """Where the arrival stands that led to the wait; a wait after another needs both."""
    ends = (i for i, event in _events(moments[:since]) if (event.kind, event.who) == (_END, who))
    return max((index + 1 for index in ends), default=0)


def _renumbered(moments: Sequence[Moment], kept_moments: Sequence[int]) -> Iterator[Moment]:
    """What changed in a step that is left out has changed in the next."""
    changes: dict[str, int | str] = {}
    kept = set(kept_moments)
    number = 0
    for index, moment in enumerate(moments):
        changes |= moment.changes
        if index in kept:
            number += 1
            yield replace(moment, number=number, changes=changes)
            changes = {}


def _closing(
    waits: Sequence[Standstill],
    groups: Mapping[str, str],
    names: Mapping[str, str],
    *,
    is_full: bool,
) -> str:
    parts = list(dict.fromkeys(_state_of(wait, groups, names) for wait in waits))
    if is_full:
        parts.append('no thread is left')
    return f'nothing moves any more: {"; ".join(parts)}'


def _state_of(wait: Standstill, groups: Mapping[str, str], names: Mapping[str, str]) -> str:
    group = groups.get(wait.who)
    words = wait.said(names)
    if group is None or group not in map(groups.get, wait.enders):
        return words
    return f'{words}, and keeps {names.get(group, f"group {group}")} closed'


def _events(moments: Sequence[Moment]) -> Iterator[tuple[int, Event]]:
    for index, moment in enumerate(moments):
        for event in moment.events:
            yield index, event
