"""
Execution traces: read what a traced process wrote, write it for people.

The exported trace is JSON lines. First one line for each process, then its entities, then its
events in the order of their clock; two threads may be out of order by the time that one step
takes. An hour of it is many gigabytes: it is read as it is written, and never held as a whole.
"""

from __future__ import annotations

import json
import mmap
import os
from collections.abc import Iterable, Iterator, Mapping
from heapq import heappush, heappushpop
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple, TextIO, cast

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.live.recorder.events import (
    EVENT_NAMES,
    LOST,
    RAW_SUFFIX,
    RESUME,
    RUN,
    THREAD_NAME,
    VAIN,
    Fields,
    rows,
)
from ros2cc_extract.extract.live.recordings.collect import home_of
from ros2cc_extract.extract.live.recordings.recording import Recording
from ros2cc_extract.files import open_regular
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

FORMAT = 'ros2cc trace'
VERSION = 1
# How many events later one may stand than its clock says, to begin with.
_NEAR = 256


class Event(NamedTuple):
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
    What one process did; its events are read from the file whenever they are asked for.

    :param lost: how often events came faster than they could be kept.
    :param count: how many events there are.
    :param reach: how many events must be held to put them in order.
    :param vain: steps of tasks that another thread took.
    """

    recording: Recording
    file: Path
    threads: Mapping[int, str]
    lost: int
    count: int
    reach: int
    vain: frozenset[Fields] = frozenset()

    def events(self) -> Iterator[Event]:
        """Read the events in the order of their clock."""
        for fields in _ordered(_steps(self.file), self.reach):
            clock_ns, thread, what, subject = fields
            if what != VAIN and fields not in self.vain:
                yield Event(clock_ns, thread, EVENT_NAMES[what], subject)


def read_trace(recording: Recording, raw: Path | None = None) -> Trace | None:
    """
    Find the trace beside a recording; ``None`` if there is none.

    A last row cut off in the middle, as a killed process leaves it, is left out.

    :param raw: another file of its events than that of the whole trace.

    :raises InputError: when the file cannot be read.
    """
    path = Path(f'{recording.file}{RAW_SUFFIX}') if raw is None else raw
    threads: dict[int, str] = {}
    lost = count = 0
    runs: dict[tuple[int, int], Fields] = {}
    vain = set()
    try:
        for fields, name in _raw_rows(path):
            _, thread, what, subject = fields
            if what in (RUN, RESUME):
                runs[thread, subject] = fields
            elif what == VAIN and (thread, subject) in runs:
                vain.add(runs.pop((thread, subject)))
            if what == THREAD_NAME:
                threads[thread] = name
            elif what == LOST:
                lost += 1
            elif what < len(EVENT_NAMES):
                count += 1
        reach = _NEAR
        while not _is_in_order(_ordered(_steps(path), reach)):
            reach *= 8
    except FileNotFoundError:
        return None
    except OSError as error:
        raise InputError(f'cannot be read: {error.strerror}', Place(str(path))) from error
    return Trace(recording, path, threads, lost, count, reach, frozenset(vain))


def _raw_rows(path: Path) -> Iterator[tuple[Fields, str]]:
    with open_regular(path) as stream:
        if os.fstat(stream.fileno()).st_size:
            with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as mapped:
                yield from rows(cast(bytes, mapped))


def _steps(path: Path) -> Iterator[Fields]:
    return (fields for fields, _ in _raw_rows(path) if fields[2] < len(EVENT_NAMES))


def _ordered(steps: Iterable[Fields], reach: int) -> Iterator[Fields]:
    """Put in the order of the clock what is out of it by less than ``reach`` steps."""
    held: list[tuple[int, int, Fields]] = []
    for number, fields in enumerate(steps):
        row = fields[0], number, fields
        if len(held) < reach:
            heappush(held, row)
        else:
            yield heappushpop(held, row)[2]
    yield from (fields for _, _, fields in sorted(held))


def _is_in_order(steps: Iterable[Fields]) -> bool:
    clocks = (clock for clock, *_ in steps)
    return all(before <= after for before, after in pairwise(clocks))


def write_lines(traces: Iterable[Trace], stream: TextIO) -> None:
    """Write traces as JSON lines."""
    for trace in traces:
        for line in _head(trace):
            stream.write(json.dumps(line) + '\n')
        pid = trace.recording.pid
        for clock_ns, thread, name, subject in trace.events():
            stream.write(
                f'{{"process": {pid}, "clock_ns": {clock_ns}, "thread": {thread}, '
                f'"event": "{name}", "entity": {subject}}}\n'
            )


def _head(trace: Trace) -> Iterator[Mapping[str, Any]]:
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
    for subject in subjects_of(recording).values():
        yield {'process': pid, **subject}


def subjects_of(recording: Recording) -> dict[int, dict[str, Any]]:
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
