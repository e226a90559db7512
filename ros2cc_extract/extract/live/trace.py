"""
Execution traces: read what a traced process wrote, write it for people and for Perfetto.

The exported trace is JSON lines. First one line for each process, then its entities, then its
events in the order of their clock; two threads may be out of order by the time that one step
takes. ``to_chrome`` gives the JSON of ``chrome://tracing`` and ui.perfetto.dev.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TextIO

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.collect import home_of
from ros2cc_extract.extract.live.events import EVENT_NAMES, LOST, RAW_SUFFIX, THREAD_NAME, rows
from ros2cc_extract.extract.live.recording import Recording
from ros2cc_extract.places import Place

FORMAT = 'ros2cc trace'
VERSION = 1
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


@dataclass(frozen=True)
class Event:
    """
    One step of an executor.

    :param thread: the number that Python gives the thread.
    :param event: one of ``events.EVENT_NAMES``.
    :param subject: number of the entity, task or (``wait>``, ``wait<``) executor, as in the
        recording.
    """

    clock_ns: int
    thread: int
    event: str
    subject: int


@dataclass(frozen=True)
class Trace:
    """
    What one process did.

    :param lost: how often events came faster than they could be kept.
    """

    recording: Recording
    events: tuple[Event, ...]
    threads: Mapping[int, str]
    lost: int


def read_trace(recording: Recording) -> Trace | None:
    """
    Read the trace beside a recording; ``None`` if there is none.

    A last row cut off in the middle, as a killed process leaves it, is left out.

    :raises InputError: when the file cannot be read.
    """
    path = Path(f'{recording.file}{RAW_SUFFIX}')
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from error
    events, threads, lost = [], {}, 0
    for (clock_ns, thread, what, subject), name in rows(raw):
        if what == THREAD_NAME:
            threads[thread] = name
        elif what == LOST:
            lost += 1
        elif what < len(EVENT_NAMES):
            events.append(Event(clock_ns, thread, EVENT_NAMES[what], subject))
    events.sort(key=lambda event: event.clock_ns)
    return Trace(recording, tuple(events), threads, lost)


def write_lines(traces: Iterable[Trace], stream: TextIO) -> None:
    """Write traces as JSON lines."""
    for trace in traces:
        for line in _lines(trace):
            stream.write(json.dumps(line) + '\n')


def _lines(trace: Trace) -> Iterator[Mapping[str, Any]]:
    recording = trace.recording
    pid = recording.pid
    yield {
        'format': FORMAT,
        'version': VERSION,
        'process': pid,
        'argv': recording.argv,
        'rclpy': recording.rclpy,
        'lost': trace.lost,
        'threads': {str(number): name for number, name in trace.threads.items()},
    }
    for subject in _subjects(recording).values():
        yield {'process': pid, **subject}
    for event in trace.events:
        yield {
            'process': pid,
            'clock_ns': event.clock_ns,
            'thread': event.thread,
            'event': event.event,
            'entity': event.subject,
        }


def _subjects(recording: Recording) -> dict[int, dict[str, Any]]:
    """Describe entities, tasks and executors by their numbers."""
    nodes = {node.number: node.name for node in recording.nodes}
    homes = {node.number: home_of(node) for node in recording.nodes}
    found: dict[int, dict[str, Any]] = {
        entity.number: {
            'entity': entity.number,
            'kind': entity.kind,
            'node': nodes.get(entity.node) if entity.node else None,
            'group': entity.group,
            'executor': homes.get(entity.node) if entity.node else None,
            'name': entity.function.name if entity.function else entity.key or entity.kind,
            'key': entity.key,
            'period_s': entity.period_s,
        }
        for entity in recording.entities
    }
    for task in recording.tasks:
        node = nodes.get(task.node) if task.node else None
        known = {'node': node, 'executor': task.executor}
        found[task.number] = _groupless(task.number, task.kind, task.function.name, **known)
    for executor in recording.executors:
        known = {'threads': executor.threads}
        found[executor.number] = _groupless(executor.number, 'executor', executor.cls, **known)
    return found


def _groupless(number: int, kind: str, name: str, **known: Any) -> dict[str, Any]:
    return {
        'entity': number,
        'kind': kind,
        'node': None,
        'group': None,
        'executor': None,
        'name': name,
        'key': None,
        'period_s': None,
        **known,
    }


def to_chrome(traces: Iterable[Trace]) -> dict[str, Any]:
    """Give the trace-event JSON: one track for each thread and one for each callback group."""
    events = [event for trace in traces for event in _chrome_events(trace)]
    return {'traceEvents': events, 'displayTimeUnit': 'ms'}


def _chrome_events(trace: Trace) -> Iterator[dict[str, Any]]:
    pid = trace.recording.pid
    groups_pid = -pid
    subjects = _subjects(trace.recording)
    yield _named('process_name', pid, 0, f'threads of process {pid}')
    yield _named('process_name', groups_pid, 0, f'callback groups of process {pid}')
    for number, name in trace.threads.items():
        yield _named('thread_name', pid, number, name)
    for number in {subject['group'] or _NO_GROUP for subject in subjects.values()}:
        yield _named('thread_name', groups_pid, number, _group_name(trace.recording, number))
    for begin, end in _stretches(trace.events, _ON_THREADS):
        yield _drawn(begin, end, subjects, pid, begin.thread)
    for begin, end in _stretches(trace.events, _IN_GROUPS):
        group = subjects.get(begin.subject, {}).get('group') or _NO_GROUP
        yield _drawn(begin, end, subjects, groups_pid, group)
    for event in trace.events:
        if event.event in _MOMENTS:
            yield {
                'ph': 'i',
                's': 't',
                'name': f'{event.event} {_short_name(event, subjects)}',
                'ts': event.clock_ns / 1e3,
                'pid': pid,
                'tid': event.thread,
            }


def _drawn(
    begin: Event, end: Event, subjects: Mapping[int, Mapping[str, Any]], pid: int, tid: int
) -> dict[str, Any]:
    name = _short_name(begin, subjects)
    return {
        'ph': 'X',
        'name': f'{name} waits' if begin.event == 'wait>' else name,
        'ts': begin.clock_ns / 1e3,
        'dur': (end.clock_ns - begin.clock_ns) / 1e3,
        'args': subjects.get(begin.subject, {}),
        'pid': pid,
        'tid': tid,
    }


def _short_name(event: Event, subjects: Mapping[int, Mapping[str, Any]]) -> str:
    name: str = subjects.get(event.subject, {}).get('name', '?')
    return name.rpartition('.')[2]


def _stretches(
    events: Iterable[Event], begun_by: Mapping[str, tuple[str, ...]]
) -> Iterator[tuple[Event, Event]]:
    """Pair begins with ends; what had not ended when the trace stopped is left out."""
    openers = {name for names in begun_by.values() for name in names}
    opened: dict[int, list[Event]] = {}
    for event in events:
        if event.event in openers:
            opened.setdefault(event.subject, []).append(event)
        elif event.event in begun_by:
            begun = opened.get(event.subject, [])
            fitting = [each for each in begun if each.event in begun_by[event.event]]
            # A coroutine may end in another thread than it began in.
            own = [each for each in fitting if each.thread == event.thread] or fitting
            if own:
                begun.remove(own[-1])
                yield own[-1], event


def _group_name(recording: Recording, number: int) -> str:
    group = next((each for each in recording.groups if each.number == number), None)
    if group is None:
        return 'in no group'
    node = next((each.name for each in recording.nodes if each.number == group.node), None)
    default = f'default group of {node}' if group.default else f'group {number}'
    return f'{default} ({group.kind})'


def _named(what: str, pid: int, tid: int, name: str) -> dict[str, Any]:
    return {'ph': 'M', 'name': what, 'pid': pid, 'tid': tid, 'args': {'name': name}}
