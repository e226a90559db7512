"""
Draws traces for ui.perfetto.dev and chrome://tracing: the JSON of the trace event format.

One track for each thread, and one for each callback group; where runs of a group lie side by
side, one for each at a time, because slices of one track must not overlap. What had not ended
when the trace stopped is drawn without an end. Perfetto (``json_trace_utils.cc``) puts all that is
below a number that is negative or has more than 32 bits into one track, so threads and groups are
numbered anew. Written event by event, in memory for one.
"""

from __future__ import annotations

import itertools
import json
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from heapq import heappop, heappush
from typing import Any, TextIO

from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.extract.live.recordings.trace import Event, Trace, subjects_of

# What ends a stretch of time, and what it can have begun with. A coroutine that pauses leaves its
# thread and stays in its group.
_ON_THREADS = {
    'end': ('begin', 'resume'),
    'suspend': ('begin', 'resume'),
    'pause': ('run',),
    'wait<': ('wait>',),
}
_IN_GROUPS = {'end': ('begin',), 'pause': ('run',)}
_MOMENTS = ('refused', 'collect', 'submit', 'task')
_NO_GROUP = 0
_ARGUMENTS = ('entity', 'kind', 'node', 'key', 'period_s')
Track = tuple[int, int]


def write_chrome(traces: Sequence[Trace], stream: TextIO) -> None:
    """Write the trace-event JSON of all processes."""
    # No process has the number of a thread: that would be its main thread.
    numbers = itertools.count(max((trace.recording.pid for trace in traces), default=0) + 1)
    stream.write('{"displayTimeUnit": "ms", "traceEvents": [')
    separator = '\n'
    for trace in traces:
        for event in _Drawing(trace, numbers).events():
            stream.write(f'{separator}{event}')
            separator = ',\n'
    stream.write('\n]}\n')


class _Drawing:
    """The events of one process, as texts."""

    def __init__(self, trace: Trace, numbers: Iterator[int]) -> None:
        self._trace = trace
        self._numbers = numbers
        self._pid = trace.recording.pid
        self._groups_pid = next(numbers)
        self._threads = {number: next(numbers) for number in trace.threads}
        self._subjects = subjects_of(trace.recording)
        self._names = {number: _short_name(each) for number, each in self._subjects.items()}
        self._arguments = {number: _arguments(each) for number, each in self._subjects.items()}
        self._tracks: dict[Track, int] = {}

    def events(self) -> Iterator[str]:
        pid, trace = self._pid, self._trace
        yield _named('process_name', pid, pid, f'threads of process {pid}')
        groups = f'callback groups of process {pid}'
        yield _named('process_name', self._groups_pid, self._groups_pid, groups)
        for number, name in trace.threads.items():
            yield _named('thread_name', pid, self._threads[number], name)
        on_threads, in_groups = _Stretches(_ON_THREADS), _Stretches(_IN_GROUPS)
        for event in trace.events():
            if event.event in _MOMENTS:
                yield self._moment(event)
            for begin, _, end in on_threads.take(event, 0):
                yield self._slice(begin, end, pid, self._thread(begin))
            for begin, lane, end in in_groups.take(event, self._group(event)):
                yield from self._in_group(begin, lane, end)
        for begin, _ in on_threads.unfinished():
            yield self._slice(begin, None, pid, self._thread(begin))
        for begin, lane in in_groups.unfinished():
            yield from self._in_group(begin, lane, None)

    def _thread(self, event: Event) -> int:
        return self._threads.get(event.thread, self._pid)

    def _group(self, event: Event) -> int:
        return self._subjects.get(event.subject, {}).get('group') or _NO_GROUP

    def _in_group(self, begin: Event, lane: int, end: Event | None) -> Iterator[str]:
        track = self._group(begin), lane
        if track not in self._tracks:
            self._tracks[track] = next(self._numbers)
            name = _group_name(self._trace.recording, track[0])
            shown = f'{name}, number {lane + 1} at a time' if lane else name
            yield _named('thread_name', self._groups_pid, self._tracks[track], shown)
        yield self._slice(begin, end, self._groups_pid, self._tracks[track])

    def _slice(self, begin: Event, end: Event | None, pid: int, tid: int) -> str:
        name = self._names.get(begin.subject, '"?"')
        if begin.event == 'wait>':
            name = f'{name[:-1]} waits"'
        took = f'"X", "dur": {(end.clock_ns - begin.clock_ns) / 1e3}' if end else '"B"'
        arguments = self._arguments.get(begin.subject, '{}')
        return (
            f'{{"ph": {took}, "name": {name}, "ts": {begin.clock_ns / 1e3}, '
            f'"pid": {pid}, "tid": {tid}, "args": {arguments}}}'
        )

    def _moment(self, event: Event) -> str:
        name = self._names.get(event.subject, '"?"')
        return (
            f'{{"ph": "i", "s": "t", "name": "{event.event} {name[1:]}, '
            f'"ts": {event.clock_ns / 1e3}, "pid": {self._pid}, "tid": {self._thread(event)}}}'
        )


class _Stretches:
    """
    Pairs begins with ends, and finds a lane of its track for each that no other is in.

    :param begun_by: what ends a stretch, with what it can have begun with.
    """

    def __init__(self, begun_by: Mapping[str, tuple[str, ...]]) -> None:
        self._begun_by = begun_by
        self._openers = {name for names in begun_by.values() for name in names}
        self._opened: dict[int, list[tuple[Event, int, int]]] = defaultdict(list)
        self._free: dict[int, list[int]] = defaultdict(list)
        self._lanes: dict[int, int] = defaultdict(int)

    def take(self, event: Event, track: int) -> Iterator[tuple[Event, int, Event]]:
        """Give the stretch that ``event`` ends, if it does."""
        if event.event in self._openers:
            self._opened[event.subject].append((event, self._take_lane(track), track))
        elif event.event in self._begun_by:
            begun = self._opened.get(event.subject, [])
            names = self._begun_by[event.event]
            back = range(len(begun) - 1, -1, -1)
            fitting = (at for at in back if begun[at][0].event in names)
            at = next(fitting, None)
            if at is not None:
                # A coroutine may end in another thread than it began in.
                both = itertools.chain((at,), fitting)
                own = (number for number in both if begun[number][0].thread == event.thread)
                begin, lane, track = begun.pop(next(own, at))
                heappush(self._free[track], lane)
                yield begin, lane, event

    def _take_lane(self, track: int) -> int:
        """The first that is free."""
        if self._free[track]:
            return heappop(self._free[track])
        self._lanes[track] += 1
        return self._lanes[track] - 1

    def unfinished(self) -> Iterator[tuple[Event, int]]:
        """Give what was never ended."""
        for begun in self._opened.values():
            yield from ((begin, lane) for begin, lane, _ in begun)


def _short_name(subject: Mapping[str, Any]) -> str:
    """Give the last part of a function's name as JSON; a lambda says what it serves."""
    name: str = subject['name'].rpartition('.')[2]
    served = subject['key'] or (f'{subject["period_s"]:g} s' if subject['period_s'] else '')
    return json.dumps(f'{name} {served}'.rstrip() if name.startswith('<') else name)


def _arguments(subject: Mapping[str, Any]) -> str:
    known = {key: subject[key] for key in _ARGUMENTS if subject[key] is not None}
    return json.dumps({**known, 'function': subject['name']})


def _group_name(recording: Recording, number: int) -> str:
    group = next((each for each in recording.groups if each.number == number), None)
    if group is None:
        return 'in no group'
    node = next((each.name for each in recording.nodes if each.number == group.node), None)
    default = f'default group of {node}' if group.default else f'group {number}'
    return f'{default} ({group.kind})'


def _named(what: str, pid: int, tid: int, name: str) -> str:
    event = {'ph': 'M', 'name': what, 'pid': pid, 'tid': tid, 'args': {'name': name}}
    return json.dumps(event)
