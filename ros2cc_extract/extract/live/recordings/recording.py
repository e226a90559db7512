"""
Reads the file that a hooked process writes (``snapshot.py``) into frozen values.

The file may be left over from a process that was killed at any moment; it is then valid and a
little old, because it is only ever replaced as a whole.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ros2cc_extract.errors import InputError
from ros2cc_extract.files import read_named, real_path
from ros2cc_extract.json_text import read_json
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.plain_data import Packer
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Distribution, Measured
from ros2cc_extract.spec.node_graph import Qos

FORMAT = 'ros2cc live recording'
VERSION = 1
MOST_BYTES = 256 * 1024 * 1024
MEND = 'record the process again with this version of the tool'


@dataclass(frozen=True, kw_only=True)
class Function:
    """A callback's name and where it is written."""

    name: str
    defined: Place | None
    coroutine: bool


@dataclass(frozen=True, kw_only=True)
class Stay:
    """A node's time in one executor, by the monotonic clock; without ``until_ns`` it goes on."""

    executor: int
    since_ns: int
    until_ns: int | None
    waited: bool


@dataclass(frozen=True, kw_only=True)
class RecordedExecutor:
    number: int
    cls: str
    bases: tuple[str, ...]
    own_class: bool
    created: Place | None
    threads: int | None
    default_threads: bool
    spun: str | None
    in_thread: bool | None


@dataclass(frozen=True, kw_only=True)
class RecordedCalled:
    """A function of the program that a service of rclpy calls."""

    kind: str
    function: Function
    group: int


@dataclass(frozen=True, kw_only=True)
class RecordedPublisher:
    key: str | None
    resolved_key: str | None
    type: str | None
    qos: Qos | None


@dataclass(frozen=True, kw_only=True)
class RecordedNode:
    """A node; ``publishers`` is ``None`` in a recording of an earlier version."""

    number: int
    name: str | None
    namespace: str | None
    stays: tuple[Stay, ...]
    called: tuple[RecordedCalled, ...] = ()
    publishers: tuple[RecordedPublisher, ...] | None = None


@dataclass(frozen=True, kw_only=True)
class RecordedGroup:
    number: int
    cls: str
    kind: str
    node: int | None
    default: bool
    rate: bool
    created: Place | None


@dataclass(frozen=True, kw_only=True)
class RecordedEntity:
    number: int
    kind: str
    cls: str
    node: int | None
    group: int
    key: str | None
    resolved_key: str | None
    period_s: float | None
    function: Function | None
    execute: Function | None
    builtin: bool
    library: str | None
    late: bool
    destroyed: bool
    made: int
    in_callback: bool
    in_configure: bool
    created: Place | None
    measured: Measured
    type: str | None = None
    qos: Qos | None = None


@dataclass(frozen=True, kw_only=True)
class RecordedTask:
    number: int
    kind: str
    executor: int
    node: int | None
    function: Function
    count: int


@dataclass(frozen=True, kw_only=True)
class Recording:
    """
    What one process held.

    :param main: the program's file, ``None`` where there is none (``python -c``).
    :param losses: how many failures of our own the hook swallowed, and the last of them.
    """

    file: str
    pid: int
    argv: tuple[str, ...]
    rclpy: str | None
    ended: bool
    losses: int
    last_losses: tuple[str, ...]
    executors: tuple[RecordedExecutor, ...]
    nodes: tuple[RecordedNode, ...]
    groups: tuple[RecordedGroup, ...]
    entities: tuple[RecordedEntity, ...]
    tasks: tuple[RecordedTask, ...]


PACKER: Packer[Recording] = Packer(Recording)
_OF_DAMAGE = (KeyError, TypeError, ValueError, AttributeError, AssertionError)


def read_recording(path: Path, shown_from: Path) -> Recording:
    """
    Read one file.

    :param shown_from: places below this folder are shown relative to it.
    :raises InputError: if the file cannot be read or is not a recording.
    """
    try:
        data = read_json(read_named(path, MOST_BYTES))
    except ValueError as error:
        raise InputError('is no recording (not JSON)', Place(str(path)), MEND) from error
    if not isinstance(data, dict) or data.get('format') != FORMAT:
        raise InputError('is no recording of a live process', Place(str(path)), MEND)
    if data.get('version') != VERSION:
        raise InputError(
            f'is a recording of version {data.get("version")}, not {VERSION}',
            Place(str(path)),
            MEND,
        )
    try:
        # Packed and unpacked, each value is one of the type that its field says, or refused.
        return PACKER.unpack(PACKER.pack(_Reader(shown_from).recording(str(path), data)))
    except _OF_DAMAGE as error:
        raise InputError(f'is a damaged recording: {error!r}', Place(str(path)), MEND) from error


class _Reader:
    """Turns JSON objects into values; one of ``_OF_DAMAGE`` on a damaged one."""

    def __init__(self, shown_from: Path) -> None:
        self._shown_from = shown_from

    def recording(self, file: str, data: Mapping[str, Any]) -> Recording:
        process, losses = data['process'], data['losses']
        return Recording(
            file=file,
            pid=process['pid'],
            argv=tuple(process['argv']),
            rclpy=process['rclpy'],
            ended=data['ended'],
            losses=losses['count'],
            last_losses=tuple(losses['last']),
            executors=tuple(map(self._executor, data['executors'])),
            nodes=tuple(map(self._node, data['nodes'])),
            groups=tuple(map(self._group, data['groups'])),
            entities=tuple(map(self._entity, data['entities'])),
            tasks=tuple(map(self._task, data['tasks'])),
        )

    def _executor(self, row: Mapping[str, Any]) -> RecordedExecutor:
        return RecordedExecutor(
            number=row['number'],
            cls=row['class'],
            bases=tuple(row['bases']),
            own_class=row['own_class'],
            created=self._place(row['created']),
            threads=row['threads'],
            default_threads=row['default_threads'],
            spun=row['spun'],
            in_thread=row['in_thread'],
        )

    def _node(self, row: Mapping[str, Any]) -> RecordedNode:
        stays = tuple(
            Stay(
                executor=stay['executor'],
                since_ns=stay['since'],
                until_ns=stay['until'],
                waited=stay['waited'],
            )
            for stay in row['stays']
        )
        return RecordedNode(
            number=row['number'],
            name=row['name'],
            namespace=row['namespace'],
            stays=stays,
            called=tuple(map(self._called, row.get('called', ()))),
            publishers=_publishers(row.get('publishers')),
        )

    def _called(self, row: Mapping[str, Any]) -> RecordedCalled:
        function = self._function(row['function'])
        assert function is not None, 'what has no name is not recorded'
        return RecordedCalled(kind=row['kind'], function=function, group=row['group'])

    def _group(self, row: Mapping[str, Any]) -> RecordedGroup:
        return RecordedGroup(
            number=row['number'],
            cls=row['class'],
            kind=row['kind'],
            node=row['node'],
            default=row['default'],
            rate=row['rate'],
            created=self._place(row['created']),
        )

    def _entity(self, row: Mapping[str, Any]) -> RecordedEntity:
        return RecordedEntity(
            number=row['number'],
            kind=row['kind'],
            cls=row['class'],
            node=row['node'],
            group=row['group'],
            key=row['key'],
            resolved_key=row['resolved_key'],
            period_s=row['period_s'],
            function=self._function(row['function']),
            execute=self._function(row['execute']),
            builtin=row['builtin'],
            library=row['library'],
            late=row['late'],
            destroyed=row['destroyed'],
            made=row['made'],
            in_callback=row['in_callback'],
            in_configure=row['in_configure'],
            created=self._place(row['created']),
            measured=_measured(row['measured']),
            type=row.get('type'),
            qos=_qos(row.get('qos')),
        )

    def _task(self, row: Mapping[str, Any]) -> RecordedTask:
        function = self._function(row['function'])
        assert function is not None, 'tasks without a function are not recorded'
        return RecordedTask(
            number=row['number'],
            kind=row['kind'],
            executor=row['executor'],
            node=row['node'],
            function=function,
            count=row['count'],
        )

    def _function(self, row: Mapping[str, Any] | None) -> Function | None:
        if row is None:
            return None
        return Function(
            name=row['name'], defined=self._place(row['defined']), coroutine=row['coroutine']
        )

    def _place(self, row: tuple[str, int, int] | None) -> Place | None:
        if row is None:
            return None
        file, line, column = row
        try:
            shown = real_path(file).relative_to(real_path(self._shown_from)).as_posix()
        except ValueError:
            shown = file
        return Place(shown, line, column)


def _publishers(rows: Sequence[Mapping[str, Any]] | None) -> tuple[RecordedPublisher, ...] | None:
    if rows is None:
        return None
    return tuple(
        RecordedPublisher(
            key=row['key'],
            resolved_key=row['resolved_key'],
            type=row['type'],
            qos=_qos(row['qos']),
        )
        for row in rows
    )


def _qos(row: Mapping[str, Any] | None) -> Qos | None:
    return None if row is None else Qos(**row)


def _measured(row: Mapping[str, Any]) -> Measured:
    return Measured(
        count=row['count'],
        refused=row['refused'],
        running=row['running'],
        threads=row['threads'],
        period=_distribution(row['period']),
        duration=_distribution(row['duration']),
    )


def _distribution(row: Mapping[str, float] | None) -> Distribution | None:
    return None if row is None else Distribution(**row)
