"""Reads recorded executions: what ``ros2cc-extract run --trace`` writes, JSON lines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from pathlib import Path
from types import NoneType
from typing import Any

from ros2cc_extract.errors import InputError
from ros2cc_extract.files import read_named
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MOST_BYTES = 1_000_000_000
FORMAT = 'ros2cc trace'
VERSION = 1
EXECUTOR = 'executor'
_MEND = 'record it with: ros2cc-extract run --trace FILE -- COMMAND'


@dataclass(frozen=True)
class Subject:
    """
    What an event is about: an entity, a task or an executor.

    :param group: number of its callback group.
    :param executor: number of the executor that serves it.
    :param name: qualified name of its function, else its topic or service.
    :param threads: of an executor with a pool.
    """

    number: int
    kind: str
    node: str | None
    group: int | None
    executor: int | None
    name: str
    key: str | None
    threads: int | None = None


@dataclass(frozen=True)
class Event:
    """One recorded step; ``name`` as in the table of ``docs/live.md``."""

    clock_ns: int
    thread: int
    name: str
    subject: int


@dataclass(frozen=True)
class Trace:
    """
    What one process did, in the order of its clock.

    :param lost: how often events came faster than they could be kept.
    :param threads: names of the threads by their numbers.
    """

    process: int
    rclpy: str | None
    lost: int
    threads: Mapping[int, str]
    subjects: Mapping[int, Subject] = field(repr=False)
    events: tuple[Event, ...] = field(repr=False)

    def executors(self) -> tuple[Subject, ...]:
        """The executors of the process, in the order of their making."""
        return tuple(s for s in self.subjects.values() if s.kind == EXECUTOR)


def read_traces(path: Path) -> tuple[Trace, ...]:
    """
    Read a trace file: one trace for each process in it.

    :raises InputError: when it cannot be read or is no trace.
    """
    try:
        text = read_named(path, MOST_BYTES).decode('utf-8')
    except UnicodeDecodeError:
        raise InputError('is no trace (no UTF-8 text)', Place(str(path)), _MEND) from None
    lines = list(_lines(text, path))
    headers = [line for line in lines if 'format' in line]
    if not headers:
        raise InputError('is no trace: no line of a process', Place(str(path)), _MEND)
    try:
        return tuple(_trace(header, lines, path) for header in headers)
    except KeyError as error:
        what = f'is a damaged trace: {error} is missing'
        raise InputError(what, Place(str(path)), _MEND) from None
    except TypeError as error:
        what = f'is a damaged trace: {error.args[0]!r} has a value of another type'
        raise InputError(what, Place(str(path)), _MEND) from None


def _lines(text: str, path: Path) -> Iterator[Mapping[str, Any]]:
    for number, line in enumerate(text.splitlines(), start=1):
        try:
            data = read_json(line)
        except ValueError:
            data = None
        if not isinstance(data, dict):
            raise InputError('is no line of a trace', Place(str(path), number), _MEND)
        yield data


def _trace(header: Mapping[str, Any], lines: Sequence[Mapping[str, Any]], path: Path) -> Trace:
    if header['format'] != FORMAT or header['version'] != VERSION:
        known = f'{FORMAT} {VERSION}'
        found = f'{header["format"]} {header["version"]}'
        raise InputError(f'is a {found}, not a {known}', Place(str(path)), _MEND)
    process = _value(header, 'process', int)
    own = [line for line in lines if line['process'] == process]
    subjects = (_subject(line) for line in own if 'kind' in line)
    return Trace(
        process,
        _value(header, 'rclpy', str, NoneType),
        _value(header, 'lost', int),
        _threads(_value(header, 'threads', dict)),
        {subject.number: subject for subject in subjects},
        tuple(_event(line) for line in own if 'event' in line),
    )


def _subject(line: Mapping[str, Any]) -> Subject:
    return Subject(
        _value(line, 'entity', int),
        _value(line, 'kind', str),
        _value(line, 'node', str, NoneType),
        _value(line, 'group', int, NoneType),
        _value(line, 'executor', int, NoneType),
        _value(line, 'name', str),
        _value(line, 'key', str, NoneType),
        _value({'threads': None, **line}, 'threads', int, NoneType),
    )


def _event(line: Mapping[str, Any]) -> Event:
    return Event(
        _value(line, 'clock_ns', int),
        _value(line, 'thread', int),
        _value(line, 'event', str),
        _value(line, 'entity', int),
    )


def _threads(names: Mapping[str, Any]) -> dict[int, str]:
    if not all(number.isdecimal() and isinstance(name, str) for number, name in names.items()):
        raise TypeError('threads')
    return {int(number): name for number, name in names.items()}


def _value(line: Mapping[str, Any], name: str, *kinds: type) -> Any:
    value = line[name]
    if not isinstance(value, kinds):
        raise TypeError(name)
    return value
