"""
The only place that reads and writes the YAML of a specification.

The published format is the core; our keys stand beside it, and the published generator ignores
them. Writing and reading is the identity on values, and on every text written here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Activity,
    Callback,
    CallbackGroup,
    Executor,
    Origin,
    Spec,
    Unresolved,
)
from ros2cc_extract.spec.yaml.codecs import (
    COUNT,
    TEXT,
    Codec,
    JsonSchema,
    listing,
    member,
    optional,
)
from ros2cc_extract.spec.yaml.cursor import Cursor, compose
from ros2cc_extract.spec.yaml.fields import Flow, Plain, record
from ros2cc_extract.spec.yaml.key_tables import (
    ACTIVITY,
    BLOCKING,
    CALLBACK,
    EXECUTOR,
    GROUP,
    PROCESS_NAME,
    UNRESOLVED,
)

MOST_BYTES = 8_000_000
SPEC_VERSION = 2
READ_VERSIONS = (1, 2)
"""Version 1 knows no wakers and no activities: what ends its waits is then open."""


@dataclass(frozen=True, kw_only=True)
class _Header:
    spec_version: int = SPEC_VERSION
    origin: Origin = Origin.MANUAL
    rclpy: str | None = None
    entry: str | None = None
    sources: tuple[str, ...] = ()
    nodes: tuple[str, ...] = ()
    unresolved: tuple[Unresolved, ...] = ()


@dataclass(frozen=True, kw_only=True)
class _Node:
    name: str
    callbacks: tuple[Callback, ...]
    groups: tuple[CallbackGroup, ...]
    executor: Executor
    activities: tuple[Activity, ...] = ()
    handed: tuple[Activity, ...] = ()
    set_up: tuple[Blocking, ...] = ()


def _always(_owner: Any) -> bool:
    return True


_HEADER = record(
    _Header,
    (
        Plain('spec_version', 'spec_version', COUNT),
        Plain('origin', 'origin', member(Origin)),
        Plain('rclpy', 'rclpy', optional(TEXT)),
        Plain('entry', 'entry', optional(TEXT), None),
        Plain('sources', 'sources', listing(TEXT)),
        Plain('nodes', 'nodes', listing(TEXT), ()),
        Plain('unresolved', 'unresolved', listing(UNRESOLVED)),
    ),
    required=('spec_version',),
)
_NODE = record(
    _Node,
    (
        Plain('name', 'name', PROCESS_NAME),
        Plain('callbacks', 'callbacks', listing(CALLBACK, at_least=1)),
        Plain('callback_groups', 'groups', listing(GROUP, at_least=1)),
        Plain('executor', 'executor', EXECUTOR),
        Plain('activities', 'activities', listing(ACTIVITY), ()),
        Plain('handed', 'handed', listing(ACTIVITY), ()),
        Plain('set_up', 'set_up', listing(BLOCKING), ()),
    ),
    required=('name', 'callbacks', 'callback_groups', 'executor'),
)


def _decode(cursor: Cursor) -> Spec:
    found = cursor.mapping(('ros2cc', 'node'), ('node',))
    header = _HEADER.decode(found['ros2cc']) if 'ros2cc' in found else _Header()
    if header.spec_version not in READ_VERSIONS:
        raise found['ros2cc'].error(
            f'spec_version {header.spec_version} is not known',
            f'this tool reads {" and ".join(map(str, READ_VERSIONS))}',
        )
    node = _NODE.decode(found['node'])
    _check_names(found['node'])
    return Spec(
        name=node.name,
        callbacks=node.callbacks,
        groups=node.groups,
        executor=node.executor,
        activities=node.activities,
        handed=node.handed,
        set_up=node.set_up,
        origin=header.origin,
        nodes=header.nodes,
        sources=header.sources,
        entry=header.entry,
        rclpy=header.rclpy,
        unresolved=header.unresolved,
    )


def _encode(spec: Spec) -> dict[str, Any]:
    header = _Header(
        origin=spec.origin,
        rclpy=spec.rclpy,
        entry=spec.entry,
        sources=spec.sources,
        nodes=spec.nodes,
        unresolved=spec.unresolved,
    )
    node = _Node(
        name=spec.name,
        callbacks=spec.callbacks,
        groups=spec.groups,
        executor=spec.executor,
        activities=spec.activities,
        handed=spec.handed,
        set_up=spec.set_up,
    )
    written: dict[str, Any] = {} if header == _Header() else {'ros2cc': _HEADER.encode(header)}
    return {**written, 'node': _NODE.encode(node)}


_DOCUMENT_SCHEMA: JsonSchema = {
    '$schema': 'https://json-schema.org/draft/2020-12/schema',
    '$id': 'urn:ros2cc-extract:spec:2',
    'title': 'ros2cc-extract specification',
    'description': 'One verification unit: an executor with all nodes it serves.',
    'type': 'object',
    'properties': {'ros2cc': _HEADER.schema, 'node': _NODE.schema},
    'required': ['node'],
    'additionalProperties': False,
}
SPEC: Codec = Codec(_encode, _decode, _DOCUMENT_SCHEMA)


def _check_names(node: Cursor) -> None:
    """Refuse a name used twice and a group that is not declared, at their own lines."""
    seen: dict[str, Place] = {}
    for cursor in _name_cursors(node):
        name = cursor.text()
        if name in seen:
            raise cursor.error(
                f'duplicate name {name!r}, first used at line {seen[name].line}',
                'names of callbacks, groups, executor, threads and node must differ',
            )
        seen[name] = cursor.place
    groups = {_child(group, 'name').text() for group in _child(node, 'callback_groups').items()}
    for callback in _child(node, 'callbacks').items():
        group = _child(callback, 'callback_group')
        if group.text() not in groups:
            raise group.error(
                f'callback group {group.text()!r} does not exist',
                f'declare it under callback_groups or use one of {", ".join(sorted(groups))}',
            )


def _name_cursors(node: Cursor) -> Iterator[Cursor]:
    executor = _child(node, 'executor')
    yield _child(node, 'name')
    for parent in (_child(node, 'callbacks'), _child(node, 'callback_groups')):
        yield from (_child(item, 'name') for item in parent.items())
    yield _child(executor, 'name')
    yield from (_child(thread, 'name') for thread in _child(executor, 'threads').items())
    for key in ('activities', 'handed'):
        if any(name.value == key for name, _ in node.node.value):
            yield from (_child(each, 'name') for each in _child(node, key).items())


def _child(cursor: Cursor, key: str) -> Cursor:
    value = next(value for name, value in cursor.node.value if name.value == key)
    return Cursor(value, cursor.file, f'{cursor.path}.{key}')


def read_specs(text: str, file: str) -> tuple[Spec, ...]:
    """
    Read every document of a YAML text.

    :raises SpecFormatError: at the first fault, with file, line and how to mend it.
    """
    specs = tuple(_decode(cursor) for cursor in compose(text, file))
    if not specs:
        raise SpecFormatError(
            'the file is empty', Place(file), 'a specification is a YAML mapping with the key node'
        )
    return specs


def load_specs(path: Path) -> tuple[Spec, ...]:
    """Read a YAML file, or what comes through a pipe without a suffix; see ``read_specs``."""
    try:
        text = read_named(path, MOST_BYTES, pipes=not path.suffix).decode('utf-8')
    except UnicodeDecodeError as error:
        raise SpecFormatError(
            f'no UTF-8 text (byte {error.start})', Place(str(path)), 'is this a YAML file?'
        ) from None
    return read_specs(text, str(path))


def write_specs(specs: Iterable[Spec]) -> str:
    """Write one YAML document per unit."""
    return _COMMENT + written([SPEC.encode(spec) for spec in specs])


def written(documents: list[Any]) -> str:
    """Write plain data as YAML, one document each."""
    text = _dumped(documents, allow_unicode=True)
    if not text.replace('\n', '').isprintable():
        # YAML takes for letters what turns their order round, and a terminal obeys.
        text = _dumped(documents, allow_unicode=False)
    return text


def _dumped(documents: list[Any], *, allow_unicode: bool) -> str:
    text: str = yaml.dump_all(
        documents,
        Dumper=_Dumper,
        sort_keys=False,
        allow_unicode=allow_unicode,
        width=_NO_FOLDING,
        explicit_start=len(documents) > 1,
    )
    return text


def spec_to_data(spec: Spec) -> Mapping[str, Any]:
    """Give a unit as the plain data that its YAML holds, for JSON output."""
    data: dict[str, Any] = SPEC.encode(spec)
    return data


_COMMENT = '# Format: `ros2cc-extract spec --schema` prints its JSON Schema.\n'
_NO_FOLDING = 1_000_000


class _Dumper(yaml.SafeDumper):
    """Indents lists below their key and writes no anchors."""

    def increase_indent(self, flow: bool = False, indentless: bool = False) -> None:
        super().increase_indent(flow, False)

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _represent_flow(dumper: yaml.SafeDumper, data: Flow) -> yaml.Node:
    return dumper.represent_mapping('tag:yaml.org,2002:map', data.items(), flow_style=True)


def _represent_text(dumper: yaml.SafeDumper, data: str) -> yaml.Node:
    """Write any text on one line; else its own lines could pass for others."""
    style = None if data.isprintable() else '"'
    return dumper.represent_scalar('tag:yaml.org,2002:str', data, style=style)


_Dumper.add_representer(str, _represent_text)
_Dumper.add_representer(Flow, _represent_flow)
