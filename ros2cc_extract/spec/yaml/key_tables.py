"""The rows of every value of the format, in the order in which they are written."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Access, Act, Blocking, Needs, Waker
from ros2cc_extract.spec.identifiers import complaint, complaint_of_executor
from ros2cc_extract.spec.model import (
    Activity,
    ActivityKind,
    Callback,
    CallbackGroup,
    CallbackType,
    Distribution,
    EntityKind,
    Executor,
    GroupType,
    Measured,
    Unresolved,
    When,
)
from ros2cc_extract.spec.yaml.codecs import (
    COUNT,
    FLAG,
    NAME,
    PLACE,
    SECONDS,
    TEXT,
    Codec,
    JsonSchema,
    listing,
    member,
    optional,
)
from ros2cc_extract.spec.yaml.cursor import Cursor
from ros2cc_extract.spec.yaml.fields import (
    ABSENT,
    Escape,
    Open,
    Plain,
    Resolution,
    Row,
    plain_rows,
    record,
)


def _name_of_process(complaint: Callable[[str], str | None]) -> Codec:
    def decode(cursor: Cursor) -> str:
        name = cursor.text()
        what = complaint(name)
        if what:
            raise cursor.error(what, 'rename it: the model names a process by it')
        return name

    return Codec(NAME.encode, decode, NAME.schema)


PROCESS_NAME = _name_of_process(complaint)
_PLACES = listing(PLACE)
_OPTIONAL_PLACE = optional(PLACE)

_CHAIN = ('chain', 'chain', _PLACES)
_SOURCE = ('source', 'source', _OPTIONAL_PLACE)

WAKER = record(
    Waker,
    (
        Plain('by', 'by', TEXT),
        *plain_rows(
            Waker,
            (
                ('after', 'after', optional(COUNT)),
                ('conditional', 'conditional', FLAG),
                ('until', 'until', optional(COUNT)),
                ('held', 'held', listing(TEXT)),
                ('passed', 'passed', listing(TEXT)),
                _SOURCE,
            ),
        ),
    ),
    required=('by',),
    flow=True,
)
BLOCKING = record(
    Blocking,
    (
        Plain('call', 'call', TEXT),
        Open(('waits_for',), 'on', TEXT, ('waits_for_resolved', False), 'waits_for_', None),
        Open(('seconds',), 'seconds', SECONDS, ('seconds_resolved', False), 'seconds_', None),
        *plain_rows(
            Blocking,
            (
                ('foreign', 'foreign', FLAG),
                ('resource', 'resource', optional(TEXT)),
                ('needs', 'needs', member(Needs)),
                ('signals', 'signals', COUNT),
                ('forgets', 'forgets', FLAG),
                ('initial', 'initial', COUNT),
                ('wakers', 'wakers', listing(WAKER)),
                ('conditional', 'conditional', FLAG),
                ('only_if', 'only_if', optional(TEXT)),
                ('assumed', 'assumed', optional(TEXT)),
                ('unread', 'unread', optional(TEXT)),
                ('answer_to', 'answer_to', optional(TEXT)),
                ('cleared_late', 'cleared_late', optional(TEXT)),
                ('unsent', 'unsent', optional(TEXT)),
                ('at_end', 'at_end', _OPTIONAL_PLACE),
                ('repeats', 'repeats', FLAG),
                ('recursive', 'recursive', FLAG),
                ('times', 'times', COUNT),
                ('or_more', 'or_more', FLAG),
                ('caught', 'caught', FLAG),
                ('held', 'held', listing(TEXT)),
                _SOURCE,
                _CHAIN,
            ),
        ),
        Escape('escapes'),
    ),
    required=('call',),
    flow=True,
)
ACCESS = record(
    Access,
    (
        Plain('name', 'name', TEXT),
        *plain_rows(
            Access,
            (
                ('update', 'update', FLAG),
                ('in_place', 'in_place', FLAG),
                ('whole', 'whole', FLAG),
                ('keeps_size', 'keeps_size', FLAG),
                ('moves', 'moves', optional(TEXT)),
                ('iterates', 'iterates', optional(TEXT)),
                ('item', 'item', optional(TEXT)),
                ('chosen', 'chosen', FLAG),
                ('rests', 'rests', FLAG),
                ('bare', 'bare', FLAG),
                ('clears', 'clears', FLAG),
                ('lowers', 'lowers', FLAG),
                ('fills_none', 'fills_none', FLAG),
                ('found', 'found', optional(TEXT)),
                ('constant', 'constant', FLAG),
                ('literal', 'literal', FLAG),
                ('at_once', 'at_once', FLAG),
                ('compared', 'compared', FLAG),
                ('looks_up', 'looks_up', optional(TEXT)),
                ('asked', 'asked', FLAG),
                ('fresh', 'fresh', FLAG),
                ('admits', 'admits', FLAG),
                ('later', 'later', FLAG),
                ('joins', 'joins', optional(TEXT)),
                ('akin', 'akin', FLAG),
                ('turn', 'turn', _PLACES),
                ('locks', 'locks', listing(TEXT)),
                _SOURCE,
                _CHAIN,
            ),
        ),
    ),
    required=('name',),
    flow=True,
)
ACT = record(
    Act,
    (
        Open(('name',), 'name', TEXT, ('name_resolved', False), 'name_'),
        *plain_rows(
            Act,
            (
                ('held', 'held', listing(TEXT)),
                ('tries', 'tries', FLAG),
                ('repeats', 'repeats', FLAG),
                ('after', 'after', COUNT),
                ('conditional', 'conditional', FLAG),
                _SOURCE,
                _CHAIN,
            ),
        ),
    ),
    flow=True,
)


DISTRIBUTION = record(
    Distribution,
    tuple(Plain(name, name, SECONDS) for name in ('min_s', 'median_s', 'p99_s', 'max_s')),
    required=('min_s', 'median_s', 'p99_s', 'max_s'),
    flow=True,
)
MEASURED = record(
    Measured,
    (
        Plain('count', 'count', COUNT),
        *plain_rows(
            Measured,
            (
                ('refused', 'refused', COUNT),
                ('running', 'running', COUNT),
                ('threads', 'threads', COUNT),
                ('period', 'period', optional(DISTRIBUTION)),
                ('duration', 'duration', optional(DISTRIBUTION)),
            ),
        ),
    ),
    required=('count',),
    flow=True,
)


def _is_extracted(callback: Callback) -> bool:
    return callback.entity is not None


def _key_name(callback: Callback) -> str | None:
    return callback.entity.key_name if callback.entity else None


def _period_name(callback: Callback) -> str | None:
    return 'period_s' if callback.entity is EntityKind.TIMER else None


def _node_name(callback: Callback) -> str | None:
    return 'node' if callback.node is not None else None


CALLBACK = record(
    Callback,
    (
        Plain('name', 'name', PROCESS_NAME),
        Plain('type', 'type', member(CallbackType)),
        *plain_rows(Callback, (('entity', 'entity', optional(member(EntityKind))),)),
        Plain('callback_group', 'group', TEXT),
        Open(('node',), 'node', TEXT, ('node_resolved', False), 'node_', None, _node_name),
        Plain('callback', 'function', optional(TEXT), None, _is_extracted),
        *plain_rows(Callback, (('class', 'cls', optional(TEXT)),)),
        Open(
            ('topic', 'service', 'action', 'client'),
            'key',
            TEXT,
            ('key_resolved', False),
            'key_',
            None,
            _key_name,
        ),
        Open(
            ('period_s',),
            'period_s',
            SECONDS,
            ('period_resolved', False),
            'period_',
            None,
            _period_name,
        ),
        *plain_rows(Callback, (('duration_s', 'duration_s', optional(SECONDS)),)),
        Open(('count',), 'count', COUNT, ('count', 'unknown'), 'count_', 1),
        *plain_rows(
            Callback,
            (
                ('when', 'when', member(When)),
                ('conditional', 'conditional', FLAG),
                ('alternative', 'alternative', optional(TEXT)),
                ('branch', 'branch', optional(COUNT)),
                ('coroutine', 'coroutine', FLAG),
                ('one_shot', 'one_shot', FLAG),
                ('cancelled', 'cancelled', FLAG),
                ('takes_info', 'takes_info', FLAG),
                ('askers', 'askers', COUNT),
                ('destroyed', 'destroyed', FLAG),
                ('groupless', 'groupless', FLAG),
                ('library', 'library', optional(TEXT)),
                ('builtin', 'builtin', FLAG),
            ),
        ),
        Resolution(),
        *plain_rows(Callback, (('assumed', 'assumed', optional(TEXT)),)),
        Plain('blocking', 'blocking', listing(BLOCKING), (), _is_extracted),
        *plain_rows(
            Callback,
            (
                ('reads', 'reads', listing(ACCESS)),
                ('writes', 'writes', listing(ACCESS)),
                ('locks', 'locks', listing(ACT)),
                ('publishes', 'publishes', listing(ACT)),
                ('changes', 'changes', listing(ACT)),
                ('pieces', 'pieces', listing(ACCESS)),
                ('measured', 'measured', optional(MEASURED)),
                _SOURCE,
                ('defined', 'defined', _OPTIONAL_PLACE),
            ),
        ),
    ),
    required=('name', 'type', 'callback_group'),
)


ACTIVITY = record(
    Activity,
    (
        Plain('name', 'name', PROCESS_NAME),
        Plain('kind', 'kind', member(ActivityKind)),
        *plain_rows(Activity, (('function', 'function', optional(TEXT)),)),
        Open(('node',), 'node', TEXT, ('node_resolved', False), 'node_', None),
        *plain_rows(
            Activity,
            (('class', 'cls', optional(TEXT)), ('starts', 'starts', listing(WAKER))),
        ),
        Open(('count',), 'count', COUNT, ('count', 'unknown'), 'count_', 1),
        *plain_rows(
            Activity,
            (
                ('conditional', 'conditional', FLAG),
                ('daemon', 'daemon', FLAG),
            ),
        ),
        Open(('loops',), 'loops', FLAG, ('loops', 'unknown'), 'loops_', False),
        *plain_rows(
            Activity,
            (('on_loop', 'on_loop', FLAG), ('ends_first', 'ends_first', FLAG)),
        ),
        Resolution(),
        *plain_rows(
            Activity,
            (
                ('blocking', 'blocking', listing(BLOCKING)),
                ('reads', 'reads', listing(ACCESS)),
                ('writes', 'writes', listing(ACCESS)),
                ('locks', 'locks', listing(ACT)),
                ('publishes', 'publishes', listing(ACT)),
                ('changes', 'changes', listing(ACT)),
                ('spins', 'spins', listing(ACT)),
                ('pieces', 'pieces', listing(ACCESS)),
                _SOURCE,
                ('defined', 'defined', _OPTIONAL_PLACE),
            ),
        ),
    ),
    required=('name', 'kind'),
)


def _is_default_group(group: CallbackGroup) -> bool:
    return group.default


GROUP = record(
    CallbackGroup,
    (
        Plain('name', 'name', PROCESS_NAME),
        Plain('type', 'type', member(GroupType)),
        *plain_rows(
            CallbackGroup,
            (
                ('default', 'default', FLAG),
                ('node', 'node', optional(TEXT)),
                ('class', 'cls', optional(TEXT)),
                ('groupless', 'groupless', FLAG),
                ('library', 'library', optional(TEXT)),
                ('builtin', 'builtin', FLAG),
            ),
        ),
        Open(('count',), 'count', COUNT, ('count', 'unknown'), 'count_', 1),
        Resolution(),
        *plain_rows(CallbackGroup, (('assumed', 'assumed', optional(TEXT)),)),
        Plain('source', 'source', _OPTIONAL_PLACE, None, _is_default_group),
    ),
    required=('name', 'type'),
    flow=True,
)


@dataclass(frozen=True)
class _ExecutorKind:
    """``kind: unknown`` takes ``reason`` and ``at`` for itself: nothing else is known then."""

    attribute: str = 'kind'

    @property
    def schemas(self) -> Mapping[str, JsonSchema]:
        return {'kind': optional(TEXT).schema}

    def encode(self, owner: Executor) -> dict[str, Any]:
        if owner.kind is None:
            return {}
        if not isinstance(owner.kind, Unknown):
            return {'kind': owner.kind}
        return {'kind': _UNKNOWN_KIND, **_UNKNOWN_RESOLUTION.encode(owner)}

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        if 'kind' not in found:
            return ABSENT
        kind = optional(TEXT).decode(found['kind'])
        if kind != _UNKNOWN_KIND:
            return kind
        unknown = _UNKNOWN_RESOLUTION.decode(found)
        return Unknown('not stated') if unknown is ABSENT else unknown


class _ExecutorResolution(Resolution):
    """Holds only where the kind is known."""

    def encode(self, owner: Executor) -> dict[str, Any]:
        return {} if isinstance(owner.kind, Unknown) else super().encode(owner)

    def decode(self, found: Mapping[str, Cursor]) -> Any:
        if 'kind' in found and found['kind'].node.value == _UNKNOWN_KIND:
            return ABSENT
        return super().decode(found)


_UNKNOWN_KIND = 'unknown'
_UNKNOWN_RESOLUTION = Resolution('kind')


def _thread_schema() -> JsonSchema:
    return record(dict, (Plain('name', 'name', PROCESS_NAME),), required=('name',)).schema


THREAD = Codec(
    lambda name: {'name': name},
    lambda cursor: PROCESS_NAME.decode(cursor.mapping(('name',), ('name',))['name']),
    _thread_schema(),
)
EXECUTOR_ROWS: tuple[Row, ...] = (
    Plain('name', 'name', _name_of_process(complaint_of_executor)),
    _ExecutorKind(),
    _ExecutorResolution(),
    Plain('threads', 'threads', listing(THREAD, at_least=1)),
    *plain_rows(
        Executor,
        (
            ('import_caught', 'import_caught', FLAG),
            ('threads_source', 'threads_source', optional(TEXT)),
            ('in_thread', 'in_thread', FLAG),
            ('spun', 'spun', optional(TEXT)),
            ('alternative', 'alternative', optional(TEXT)),
            ('branch', 'branch', optional(COUNT)),
            ('assumed', 'assumed', optional(TEXT)),
            _SOURCE,
        ),
    ),
)
EXECUTOR = record(Executor, EXECUTOR_ROWS, required=('name', 'threads'))

UNRESOLVED = record(
    Unresolved,
    (
        Plain('subject', 'subject', TEXT),
        Plain('fact', 'fact', TEXT),
        Plain('reason', 'reason', TEXT),
        *plain_rows(Unresolved, (_SOURCE,)),
    ),
    required=('subject', 'fact', 'reason'),
    flow=True,
)
