"""The YAML of a system, as ``schema.json`` describes it; the units keep their format."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from importlib.resources import files
from typing import Any

from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.node_graph import Qos
from ros2cc_extract.spec.system.launched import ANY_NODE, Fact, Launched, SetParameter
from ros2cc_extract.spec.system.model import Connection, Process, System, SystemNode
from ros2cc_extract.spec.yaml.yaml_io import spec_to_data, written

VERSION = 1
_COMMENT = '# System specification of ros2cc-extract, see docs/system.md.\n'


def write_system(system: System) -> str:
    """The system as YAML."""
    return write_systems([system])


def write_systems(systems: Iterable[System]) -> str:
    """One YAML document for each."""
    return _COMMENT + written([system_data(system) for system in systems])


def system_schema() -> str:
    """The JSON schema of the format."""
    return files('ros2cc_extract.spec.system').joinpath('schema.json').read_text(encoding='utf-8')


def system_data(system: System) -> dict[str, Any]:
    """The system as plain data."""
    body: dict[str, Any] = {
        'version': VERSION,
        'name': system.name,
        'sources': list(system.sources),
        'processes': [_process(each) for each in system.processes],
        'connections': [_connection(each) for each in system.connections],
    }
    if system.unresolved:
        body['unresolved'] = [
            _filled(
                {
                    'subject': each.subject,
                    'fact': each.fact,
                    'reason': each.reason,
                    'source': _place(each.source),
                }
            )
            for each in system.unresolved
        ]
    return {'system': body}


def _process(process: Process) -> dict[str, Any]:
    data = {'name': process.name, **_launched(process.launched)}
    more = {
        'file': process.file,
        'entry': process.entry,
        'outside': _reason(process.outside),
    }
    data |= _filled(more)
    data['nodes'] = [_node(each) for each in process.nodes]
    data['units'] = [dict(spec_to_data(unit)) for unit in process.units]
    return data


def _launched(launched: Launched) -> dict[str, Any]:
    data = {
        'kind': launched.kind,
        'package': _fact(launched.package),
        'executable': _fact(launched.executable),
        'command': list(launched.command),
        'node_name': _fact(launched.name),
        'namespace': _fact(launched.namespace),
        'remaps': [str(each) for each in launched.remaps],
        'parameters': [
            _filled({'name': p.name, 'value': _value(p.value), 'node': p.node})
            for p in _parameters(launched)
        ],
        'conditional': _reason(launched.conditional),
        'begun_by': launched.later,
        'source': _place(launched.source),
    }
    return _filled(data)


def _parameters(launched: Launched) -> Iterator[SetParameter]:
    """Parameters; the pattern of the node is written if it is not for all."""
    for each in launched.parameters:
        yield each if each.node != ANY_NODE else replace(each, node='')


def _node(node: SystemNode) -> dict[str, Any]:
    data = {
        'name': _fact(node.name),
        'own_name': _fact(node.own_name),
        'parameters': list(node.parameters or ()),
        'open': _reason(node.open),
        'awaits': [
            _filled(
                {
                    each.what: _fact(each.name),
                    'answers': each.answers or None,
                    'source': _place(each.source),
                }
            )
            for each in node.awaits
        ],
        'source': _place(node.source),
    }
    return _filled(data)


def _connection(connection: Connection) -> dict[str, Any]:
    ends = [
        _filled(
            {
                'kind': end.endpoint.kind.value,
                'process': end.process.name,
                'node': _fact(end.node.name),
                'written': _fact(end.endpoint.written),
                'type': end.endpoint.type,
                'qos': _qos(end.endpoint.of.qos),
                'remap': str(end.endpoint.remap) if end.endpoint.remap else None,
                'conditional': end.endpoint.conditional or None,
                'assumed': end.endpoint.assumed,
                'after': [str(each) for each in end.endpoint.of.after],
                'source': _place(end.endpoint.source),
            }
        )
        for end in connection.ends
    ]
    return {connection.what: connection.name, 'ends': ends}


def _qos(qos: Qos | None) -> dict[str, Any] | None:
    if qos is None:
        return None
    facts = {
        'reliability': _fact(qos.reliability),
        'durability': _fact(qos.durability),
        'deadline_s': _value(qos.deadline_s),
        'liveliness': _fact(qos.liveliness),
        'lease_s': _value(qos.lease_s),
    }
    return _filled(facts)


def _fact(fact: Fact | None) -> Any:
    return {'unknown': str(fact)} if isinstance(fact, Unknown) else fact


def _value(value: object) -> Any:
    if isinstance(value, Unknown):
        return {'unknown': str(value)}
    if isinstance(value, (list, tuple)):
        return [_value(each) for each in value]
    return value if isinstance(value, (str, int, float, bool)) or value is None else str(value)


def _reason(why: Unknown | None) -> str | None:
    return None if why is None else str(why)


def _place(place: Place | None) -> str | None:
    return None if place is None else str(place)


def _filled(data: dict[str, Any]) -> dict[str, Any]:
    """Without what is not there."""
    return {key: value for key, value in data.items() if value not in (None, '', [])}
