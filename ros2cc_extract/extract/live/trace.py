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
from ros2cc_extract.extract.live.recording import Recording
from ros2cc_extract.places import Place

FORMAT = 'ros2cc trace'
VERSION = 1
RAW_SUFFIX = '.jsonl'
# Each begins a stretch of time on its thread that the other ends.
_STRETCHES = {'begin': 'end', 'run': 'pause'}
_OPENERS = {end: begin for begin, end in _STRETCHES.items()}
_NO_GROUP = 0


@dataclass(frozen=True)
class Event:
    """
    One step of an executor.

    :param thread: the number that the system gave the thread.
    :param event: begin, refused, end, collect, take, task, run or pause.
    :param subject: number of the entity or task, as in the recording.
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

    A last line cut off in the middle, as a killed process leaves it, is left out.

    :raises InputError: when the file cannot be read.
    """
    path = Path(f'{recording.file}l')
    try:
        rows = [row for row in map(_row, path.read_text(encoding='utf-8').splitlines()) if row]
    except FileNotFoundError:
        return None
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from error
    events = sorted(
        (Event(*row) for row in rows if isinstance(row[0], int)), key=lambda e: e.clock_ns
    )
    return Trace(
        recording,
        tuple(events),
        {row[1]: row[2] for row in rows if row[0] == 'thread'},
        sum(row[0] == 'lost' for row in rows),
    )


def _row(line: str) -> list[Any] | None:
    try:
        row = json.loads(line)
    except ValueError:
        return None
    return row if isinstance(row, list) else None


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
    """Describe entities and tasks by their numbers."""
    nodes = {node.number: node.name for node in recording.nodes}
    found: dict[int, dict[str, Any]] = {
        entity.number: {
            'entity': entity.number,
            'kind': entity.kind,
            'node': nodes.get(entity.node) if entity.node else None,
            'group': entity.group,
            'name': entity.function.name if entity.function else entity.key or entity.kind,
            'key': entity.key,
            'period_s': entity.period_s,
        }
        for entity in recording.entities
    }
    for task in recording.tasks:
        found[task.number] = {
            'entity': task.number,
            'kind': task.kind,
            'node': nodes.get(task.node) if task.node else None,
            'group': None,
            'name': task.function.name,
            'key': None,
            'period_s': None,
        }
    return found


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
    for group in {subject['group'] or _NO_GROUP for subject in subjects.values()}:
        yield _named('thread_name', groups_pid, group, _group_name(trace.recording, group))
    for begin, end in _stretches(trace):
        subject = subjects.get(begin.subject, {'name': '?', 'group': None})
        drawn = {
            'ph': 'X',
            'name': subject['name'].rpartition('.')[2],
            'ts': begin.clock_ns / 1e3,
            'dur': (end.clock_ns - begin.clock_ns) / 1e3,
            'args': subject,
        }
        yield {**drawn, 'pid': pid, 'tid': begin.thread}
        yield {**drawn, 'pid': groups_pid, 'tid': subject['group'] or _NO_GROUP}
    for event in trace.events:
        if event.event in ('refused', 'collect', 'task'):
            name = subjects.get(event.subject, {'name': '?'})['name'].rpartition('.')[2]
            yield {
                'ph': 'i',
                's': 't',
                'name': f'{event.event} {name}',
                'ts': event.clock_ns / 1e3,
                'pid': pid,
                'tid': event.thread,
            }


def _stretches(trace: Trace) -> Iterator[tuple[Event, Event]]:
    """Pair begins with ends; what had not ended when the trace stopped is left out."""
    opened: dict[tuple[str, int], list[Event]] = {}
    for event in trace.events:
        if event.event in _STRETCHES:
            opened.setdefault((event.event, event.subject), []).append(event)
        elif event.event in _OPENERS:
            begun = opened.get((_OPENERS[event.event], event.subject), [])
            # A coroutine may end in another thread than it began in.
            own = [each for each in begun if each.thread == event.thread] or begun
            if own:
                begin = own[-1]
                begun.remove(begin)
                yield begin, event


def _group_name(recording: Recording, number: int) -> str:
    group = next((each for each in recording.groups if each.number == number), None)
    if group is None:
        return 'in no group'
    node = next((each.name for each in recording.nodes if each.number == group.node), None)
    default = f'default group of {node}' if group.default else f'group {number}'
    return f'{default} ({group.kind})'


def _named(what: str, pid: int, tid: int, name: str) -> dict[str, Any]:
    return {'ph': 'M', 'name': what, 'pid': pid, 'tid': tid, 'args': {'name': name}}
