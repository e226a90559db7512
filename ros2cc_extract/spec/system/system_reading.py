"""Reads the YAML of a system, as ``system_yaml.py`` writes it."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from ros2cc_extract.errors import SpecFormatError
from ros2cc_extract.files import read_named
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.model import Unresolved
from ros2cc_extract.spec.node_graph import Endpoint, EndpointKind, Qos
from ros2cc_extract.spec.system.launched import ANY_NODE, Fact, Launched, SetParameter
from ros2cc_extract.spec.system.model import (
    Process,
    System,
    SystemAwaited,
    SystemEndpoint,
    SystemNode,
)
from ros2cc_extract.spec.system.names import read_remap
from ros2cc_extract.spec.system.system_yaml import VERSION
from ros2cc_extract.spec.yaml.cursor import Cursor, compose
from ros2cc_extract.spec.yaml.yaml_io import SPEC

MOST_BYTES = 256 * 1024 * 1024
_WITH_PLACE = re.compile(r'(?P<reason>.*) \((?P<place>[^()]+:\d+(?::\d+)?)\)', re.DOTALL)
_SYSTEM = ('version', 'name', 'sources', 'processes', 'connections', 'unresolved')
_PROCESS = (
    *('name', 'kind', 'package', 'executable', 'command', 'node_name', 'namespace', 'remaps'),
    *('parameters', 'conditional', 'begun_by', 'source', 'file', 'entry', 'outside', 'nodes'),
    'units',
)
_NODE = ('name', 'own_name', 'parameters', 'open', 'awaits', 'source')
_END = (
    *('kind', 'process', 'node', 'written', 'type', 'qos', 'remap', 'conditional', 'assumed'),
    *('after', 'source'),
)
_QOS = ('reliability', 'durability', 'deadline_s', 'liveliness', 'lease_s')
_NAMED = frozenset(kind.what for kind in EndpointKind)
_Ends = Mapping[tuple[str, Fact], list[SystemEndpoint]]


def is_system(text: str) -> bool:
    """Whether a YAML text is of a system, and not of units: by the key it begins with."""
    lines = (line for line in text.splitlines() if line.strip() and not line.startswith('#'))
    return next((line for line in lines if line != '---'), '').startswith('system:')


def load_systems(path: Path) -> tuple[System, ...]:
    """
    Read a file of one system, or of several.

    :raises SpecFormatError: at the first fault, with file, line and how to mend it.
    """
    try:
        text = read_named(path, MOST_BYTES).decode()
    except UnicodeDecodeError as error:
        what = f'no UTF-8 text (byte {error.start})'
        raise SpecFormatError(what, Place(str(path)), 'is this a YAML file?') from None
    return read_systems(text, str(path))


def read_systems(text: str, file: str) -> tuple[System, ...]:
    """
    Read every document of a YAML text.

    :raises SpecFormatError: at the first fault.
    """
    return tuple(
        _system(root.mapping(('system',), ('system',))['system']) for root in compose(text, file)
    )


def _system(cursor: Cursor) -> System:
    found = cursor.mapping(_SYSTEM, ('version', 'name', 'processes', 'connections'))
    if found['version'].count() != VERSION:
        raise found['version'].error(f'version is not {VERSION}', 'write it again by `system`')
    ends = _ends(found['connections'])
    unresolved = tuple(map(_unresolved, _items(found, 'unresolved')))
    open_names = {each.subject: each for each in unresolved if each.fact in _NAMED}
    return System(
        name=found['name'].text(),
        processes=tuple(_process(each, ends, open_names) for each in found['processes'].items()),
        sources=_texts(found, 'sources'),
        unresolved=unresolved,
    )


def _process(cursor: Cursor, ends: _Ends, open_names: Mapping[str, Unresolved]) -> Process:
    found = cursor.mapping(_PROCESS, ('name', 'kind', 'source', 'nodes', 'units'))
    name = found['name'].text()
    return Process(
        name=name,
        launched=_launched(found),
        file=_text(found, 'file'),
        entry=_text(found, 'entry'),
        outside=_reason(found, 'outside'),
        nodes=tuple(_node(each, name, ends, open_names) for each in found['nodes'].items()),
        units=tuple(SPEC.decode(each) for each in found['units'].items()),
    )


def _launched(found: Mapping[str, Cursor]) -> Launched:
    place = Place.parse(found['source'].text())
    remaps = (read_remap(each, place) for each in _texts(found, 'remaps'))
    return Launched(
        kind=found['kind'].text(),
        source=place,
        package=_fact(found, 'package'),
        executable=_fact(found, 'executable'),
        name=_fact(found, 'node_name'),
        namespace=_fact(found, 'namespace'),
        remaps=tuple(each for each in remaps if each is not None),
        parameters=tuple(_parameter(each, place) for each in _items(found, 'parameters')),
        command=_texts(found, 'command'),
        conditional=_reason(found, 'conditional'),
        later=_text(found, 'begun_by') or '',
    )


def _parameter(cursor: Cursor, place: Place) -> SetParameter:
    found = cursor.mapping(('name', 'value', 'node'), ('name',))
    node = _text(found, 'node') or ANY_NODE
    value = _value(found['value']) if 'value' in found else None
    return SetParameter(name=found['name'].text(), value=value, node=node, source=place)


def _value(cursor: Cursor) -> object:
    if cursor.kind == 'map':
        return _fact_of(cursor)
    if cursor.kind == 'seq':
        return tuple(map(_value, cursor.items()))
    if cursor.kind == 'bool':
        return cursor.flag()
    if cursor.kind == 'int':
        return int(cursor.number())
    return cursor.number() if cursor.kind == 'float' else cursor.text()


def _node(
    cursor: Cursor, process: str, ends: _Ends, open_names: Mapping[str, Unresolved]
) -> SystemNode:
    found = cursor.mapping(_NODE, ('name', 'own_name'))
    name, own_name = _fact_of(found['name']), _fact_of(found['own_name'])
    why = _reason(found, 'open')
    missing = open_names.get(str(own_name))
    if why is None and missing is not None:
        why = Unknown(f'a {missing.fact}: {missing.reason}', missing.source)
    return SystemNode(
        name=name,
        own_name=own_name,
        endpoints=tuple(ends.get((process, name), ())),
        parameters=_texts(found, 'parameters'),
        open=why,
        awaits=tuple(map(_awaited, _items(found, 'awaits'))),
        source=_place(found),
    )


def _awaited(cursor: Cursor) -> SystemAwaited:
    found = cursor.mapping(('service', 'action', 'answers', 'source'), ('source',))
    named = [what for what in ('service', 'action') if what in found]
    if len(named) != 1:
        raise cursor.error('one thing is awaited', 'write service or action')
    return SystemAwaited(
        what=named[0],
        name=_fact_of(found[named[0]]),
        source=Place.parse(found['source'].text()),
        answers=found['answers'].flag() if 'answers' in found else False,
    )


def _ends(cursor: Cursor) -> _Ends:
    """The endpoints by process and node."""
    by_node: dict[tuple[str, Fact], list[SystemEndpoint]] = defaultdict(list)
    for connection in cursor.items():
        found = connection.mapping((*sorted(_NAMED), 'ends'), ('ends',))
        named = [what for what in found if what != 'ends']
        if len(named) != 1:
            raise connection.error('a connection has one name', 'write topic, service or action')
        for end in found['ends'].items(at_least=1):
            known = end.mapping(_END, ('kind', 'process', 'node', 'written'))
            key = known['process'].text(), _fact_of(known['node'])
            by_node[key].append(_end(known, found[named[0]].text()))
    return by_node


def _end(found: Mapping[str, Cursor], name: str) -> SystemEndpoint:
    rule = _text(found, 'remap')
    of = Endpoint(
        kind=found['kind'].member(EndpointKind),
        name=_fact_of(found['written']),
        type=_text(found, 'type'),
        qos=_qos(found['qos']) if 'qos' in found else None,
        source=_place(found),
        conditional=found['conditional'].flag() if 'conditional' in found else False,
        assumed=_text(found, 'assumed'),
        after=tuple(map(Place.parse, _texts(found, 'after'))),
    )
    return SystemEndpoint(
        kind=of.kind,
        name=name,
        written=of.name,
        type=of.type,
        remap=read_remap(rule) if rule else None,
        source=of.source,
        conditional=of.conditional,
        assumed=of.assumed,
        of=of,
    )


def _qos(cursor: Cursor) -> Qos:
    found = cursor.mapping(_QOS)
    return Qos(
        reliability=_fact(found, 'reliability'),
        durability=_fact(found, 'durability'),
        deadline_s=_seconds(found, 'deadline_s'),
        liveliness=_fact(found, 'liveliness'),
        lease_s=_seconds(found, 'lease_s'),
    )


def _seconds(found: Mapping[str, Cursor], key: str) -> float | Unknown | None:
    if key not in found:
        return None
    fact = _fact_of(found[key]) if found[key].kind == 'map' else found[key].number()
    return fact if isinstance(fact, (float, Unknown)) else None


def _unresolved(cursor: Cursor) -> Unresolved:
    found = cursor.mapping(('subject', 'fact', 'reason', 'source'), ('subject', 'fact', 'reason'))
    return Unresolved(
        subject=found['subject'].text(),
        fact=found['fact'].text(),
        reason=found['reason'].text(),
        source=_place(found),
    )


def _items(found: Mapping[str, Cursor], key: str) -> list[Cursor]:
    return list(found[key].items()) if key in found else []


def _texts(found: Mapping[str, Cursor], key: str) -> tuple[str, ...]:
    return tuple(each.text() for each in _items(found, key))


def _text(found: Mapping[str, Cursor], key: str) -> str | None:
    return found[key].text() if key in found else None


def _place(found: Mapping[str, Cursor]) -> Place | None:
    return Place.parse(found['source'].text()) if 'source' in found else None


def _fact(found: Mapping[str, Cursor], key: str) -> Fact | None:
    return _fact_of(found[key]) if key in found else None


def _fact_of(cursor: Cursor) -> Fact:
    if cursor.kind != 'map':
        return cursor.text()
    return _why(cursor.mapping(('unknown',), ('unknown',))['unknown'].text())


def _reason(found: Mapping[str, Cursor], key: str) -> Unknown | None:
    return _why(found[key].text()) if key in found else None


def _why(text: str) -> Unknown:
    """What ``str`` writes of an ``Unknown``."""
    match = _WITH_PLACE.fullmatch(text)
    return (
        Unknown(text) if match is None else Unknown(match['reason'], Place.parse(match['place']))
    )
