"""What the probe has seen, as values: two looks at one process, at least 200 ms apart."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

_LIBRARIES = frozenset(
    {'rclpy', 'threading', 'concurrent', 'queue', 'asyncio', 'runpy', 'importlib', 'selectors'}
)
# The hook, as it is called where the tool is installed and where it is not.
_OWN = frozenset({'ros2cc_extract', '_ros2cc_live'})


@dataclass(frozen=True, kw_only=True)
class Frame:
    """
    One call of a stack.

    :param called: the function with its class if Python gives it, as ``Navigator.drive``.
    :param item: which item of its `with` it is entering, of those that stand at its place.
    :param objects: locks, events, clients … that the frame names, by name, as object numbers.
    :param endless: no time-out was given, as far as the frame shows.
    :param entity: the entity whose callback it runs, for the one frame of rclpy that does.
    """

    number: int
    file: str
    function: str
    called: str
    module: str
    line: int
    at: int
    position: tuple[int, ...] | None
    item: int | None
    objects: Mapping[str, int]
    endless: bool
    entity: int | None

    @property
    def of_program(self) -> bool:
        return self.module.partition('.')[0] not in _LIBRARIES | _OWN

    @property
    def at_line(self) -> str:
        """File and line, from the current folder where the file is below it."""
        return f'{self.file.removeprefix(_here())}:{self.line}'

    def is_in(self, module: str, *functions: str) -> bool:
        return self.module == module and (not functions or self.function in functions)


@dataclass(frozen=True, kw_only=True)
class Activity:
    """
    A thread, or a coroutine that has given its thread back; its frames from the outermost inwards.

    :param future: what a coroutine awaits.
    :param is_awaited_done: and it is done.
    :param executor: that runs the coroutine.
    """

    name: str
    frames: tuple[Frame, ...]
    ident: int | None = None
    ticks: int | None = None
    entity: int | None = None
    future: int | None = None
    is_awaited_done: bool = False
    executor: int | None = None

    @property
    def entities(self) -> tuple[int, ...]:
        """The entities whose callbacks are on the stack."""
        own = () if self.entity is None else (self.entity,)
        return own + tuple(each.entity for each in self.frames if each.entity is not None)

    @property
    def place(self) -> Frame:
        """The innermost frame of the program."""
        return next((f for f in reversed(self.frames) if f.of_program), self.frames[-1])

    def stands_as(self, before: Activity) -> bool:
        """Whether nothing has moved between two looks."""
        steps = [(f.number, f.at) for f in self.frames]
        return steps == [(f.number, f.at) for f in before.frames] and self.ticks == before.ticks


@dataclass(frozen=True, kw_only=True)
class Entity:
    """
    :param key: name of the service or of the action.
    :param there: a server for this client is there.
    :param servers: how many, for a client of a service that has asked, where rclpy can say.
    :param pending: futures of what a client has asked.
    """

    number: int
    kind: str
    cls: str
    node: str
    simulated_clock: bool
    group: int
    exclusive: bool
    active: int | None
    function: str | None
    module: str
    place: tuple[str, int] | None
    key: str | None
    domain: int | None
    there: bool
    servers: int | None
    pending: frozenset[int]
    ready: bool
    cancelled: bool

    @property
    def is_service(self) -> bool:
        return self.kind == 'services'

    @property
    def service(self) -> tuple[int | None, str | None]:
        """What a client and its servers have in common."""
        return self.domain, self.key

    @property
    def builtin(self) -> bool:
        """Made by rclpy, and running nothing of the program, as far as is known."""
        if self.kind == 'clients':
            return not self.pending
        if self.function is not None and 'set_parameters' in self.function:
            return False
        ours = self.module.partition('.')[0] in ('rclpy', 'threading')
        return ours or (self.cls == 'EventHandler' and self.function is None)


@dataclass(frozen=True, kw_only=True)
class Executor:
    number: int
    cls: str
    workers: int | None
    pool: int | None
    entities: frozenset[int]
    nodes: tuple[str, ...]
    spun: bool


@dataclass(frozen=True, kw_only=True)
class Look:
    """
    :param nodes: their full names.
    :param unread: entities that could not be read, and why.
    """

    main: int
    nodes: tuple[str, ...]
    activities: tuple[Activity, ...]
    entities: Mapping[int, Entity]
    executors: tuple[Executor, ...]
    objects: Mapping[int, Mapping[str, Any]]
    unread: tuple[str, ...]


def look_of(row: Mapping[str, Any]) -> Look:
    """
    Read one look.

    :raises KeyError, TypeError, ValueError, AttributeError: where it is none.
    """
    entities: dict[int, Entity] = {}
    names: dict[int, str] = {}
    of_node: dict[int, list[int]] = {}
    for node in row['nodes']:
        names[node['id']] = str(node['name'])
        of_node[node['id']] = [each['id'] for each in node['entities']]
        for each in node['entities']:
            entities[each['id']] = _entity(each, node)
    threads = map(_thread, (each for each in row['threads'] if each['frames']))
    own = tuple(each for each in threads if not _is_of_the_hook(each))
    return Look(
        main=int(row['main']),
        nodes=tuple(sorted(filter(None, names.values()))),
        activities=own + tuple(map(_task, row['tasks'])),
        entities=entities,
        executors=tuple(_executor(each, names, of_node) for each in row['executors']),
        objects={int(key): value for key, value in row['objects'].items()},
        unread=tuple(str(node['unread']) for node in row['nodes'] if node['unread']),
    )


def _thread(row: Mapping[str, Any]) -> Activity:
    frames = tuple(map(_frame, row['frames']))
    return Activity(
        name=str(row['name']), frames=frames, ident=int(row['ident']), ticks=row['ticks']
    )


def _is_of_the_hook(thread: Activity) -> bool:
    """Whether it is the thread that writes the recording: it has no part in what is explained."""
    first = next((f.module for f in thread.frames if f.module != 'threading'), '')
    return first.partition('.')[0] in _OWN


def _task(row: Mapping[str, Any]) -> Activity:
    frames = tuple(map(_frame, row['frames']))
    return Activity(
        name='suspended coroutine',
        frames=frames,
        entity=row['entity'],
        executor=row['executor'],
        future=int(row['future']),
        is_awaited_done=bool(row['done']),
    )


def _frame(row: Mapping[str, Any]) -> Frame:
    return Frame(
        number=int(row['id']),
        file=str(row['file']),
        function=str(row['function']),
        called=str(row['qualified']).rpartition('<locals>.')[2],
        module=str(row['module']),
        line=int(row['line'] or 0),
        at=int(row['at']),
        position=tuple(map(int, row['position'])) if row['position'] else None,
        item=None if row['item'] is None else int(row['item']),
        objects={str(name): int(number) for name, number in row['objects'].items()},
        endless=bool(row['endless']),
        entity=row['entity'],
    )


def _entity(row: Mapping[str, Any], node: Mapping[str, Any]) -> Entity:
    return Entity(
        number=int(row['id']),
        kind=str(row['kind']),
        cls=str(row['class']),
        node=str(node['name']),
        simulated_clock=bool(node['simulated_clock']),
        group=int(row['group']),
        exclusive=bool(row['exclusive']),
        active=row['active'],
        function=row['function'],
        module=str(row['module']),
        place=(str(row['place'][0]), int(row['place'][1])) if row['place'] else None,
        key=row['key'],
        domain=node['domain'],
        there=bool(row.get('there')),
        servers=row.get('servers'),
        pending=frozenset(map(int, row.get('pending', ()))),
        ready=bool(row.get('ready')),
        cancelled=bool(row.get('cancelled')),
    )


def _executor(
    row: Mapping[str, Any], names: Mapping[int, str], of_node: Mapping[int, list[int]]
) -> Executor:
    return Executor(
        number=int(row['id']),
        cls=str(row['class']),
        workers=row['workers'],
        pool=row['pool'],
        entities=frozenset(each for node in row['nodes'] for each in of_node.get(node, ())),
        nodes=tuple(sorted(names.get(node, '?') for node in row['nodes'])),
        spun=bool(row['spun']),
    )


def _here() -> str:
    try:
        return f'{os.getcwd()}{os.sep}'  # noqa: PTH109 - pathlib costs the process its import
    except OSError:
        return ''
