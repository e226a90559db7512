"""
UPPAAL's own XML of a run, as ``verifyta -X`` writes it.

Layout after two such files (Jack0Chan/PyUPPAAL, ``t2-1.xml`` and ``Pedestrian_trace1.xml``) and a
program that reads them (S-Lehmann/uppyyl-observation-matcher, ``trace/parser.py``). Their models
have no global variable and no array: those are written as their clocks and scalars are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from xml.etree import ElementTree
from xml.sax.saxutils import escape, quoteattr

from ros2cc_extract.checker.runs.printed_runs import NamedState
from ros2cc_extract.checker.uppaal.files.document import EdgeNode
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.uppaal.run import UppaalRun, location_names

ZERO, TIME = 'sys.#t(0)', 'sys.#time'


def to_xml(run: UppaalRun) -> str:
    """
    Write the layout of ``verifyta -X``, with the locations and edges that occur.

    :raises InputError: when two edges cannot be distinguished.
    """
    ids = _Ids(run)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        _tag('trace', initial_node='State1', trace_options='symbolic', close='>'),
        '<system>',
        *(_tag('clock', name=clock.removeprefix('sys.'), id=clock) for clock in (ZERO, TIME)),
        *_global_variables(run),
        *(line for process in run.templates for line in _process(run, ids, process)),
        '</system>',
        *_vectors(run, ids),
        *_zones(run),
        *_transitions(run, ids),
        '</trace>',
    ]
    return '\n'.join(lines) + '\n'


class _Ids:
    """
    Numbers of states and edges.

    :param states: by index in the run: the state that closes a cycle is the one that began it.
    :param edges: id by process and number in the template, counted by first use.
    """

    def __init__(self, run: UppaalRun) -> None:
        count = len(run.states)
        self.states = list(range(1, count + 1))
        if run.run.cycle_start is not None:
            self.states[-1] = self.states[run.run.cycle_start]
        self.edges: dict[tuple[str, int], str] = {}
        used: dict[str, int] = {}
        for edge in (edge for step in run.run.steps for edge in step.edges):
            key = edge.process, run.edge_number(edge)
            if key not in self.edges:
                used[edge.process] = used.get(edge.process, 0) + 1
                self.edges[key] = f'{edge.process}.Edge{used[edge.process]}'


def _tag(tag: str, /, *, close: str = '/>', **attributes: object) -> str:
    written = ''.join(f' {key}={quoteattr(str(value))}' for key, value in attributes.items())
    return f'<{tag}{written}{close}'


def _owner(run: UppaalRun, variable: str) -> str | None:
    owner = variable.partition('.')[0]
    return owner if '.' in variable and owner in run.templates else None


def _global_variables(run: UppaalRun) -> Iterator[str]:
    for name in run.run.initial.variables:
        if _owner(run, name) is None:
            yield _tag('variable', name=name, id=f'sys.{name}')


def _process(run: UppaalRun, ids: _Ids, process: str) -> Iterator[str]:
    template = run.templates[process]
    names = location_names(template)
    yield _tag('process', id=process, name=process, close='>')
    for name in run.run.initial.variables:
        if _owner(run, name) == process:
            yield _tag('variable', name=name.removeprefix(f'{process}.'), id=name)
    for location in dict.fromkeys(state.locations[process] for state in run.states):
        opening = _tag('location', id=f'{process}.{location}', name=location, close='>')
        yield f'{opening}<![CDATA[]]></location>'
    for (owner, number), written in ids.edges.items():
        if owner == process:
            node = template.edges[number]
            source, target = (f'{process}.{names[end]}' for end in (node.source, node.target))
            yield _tag('edge', id=written, **{'from': source}, to=target, close='>')
            yield from _labels(node)
            yield '</edge>'
    yield '</process>'


def _labels(node: EdgeNode) -> Iterator[str]:
    """Give the labels as written; what is absent is ``1``, or ``tau`` for a channel."""
    for tag, kind, absent in (
        ('guard', 'guard', '1'),
        ('sync', 'synchronisation', 'tau'),
        ('update', 'assignment', '1'),
    ):
        text = node.labels[kind].value if kind in node.labels else absent
        yield f'<{tag}>{escape(text)}</{tag}>'


def _vectors(run: UppaalRun, ids: _Ids) -> Iterator[str]:
    for number, state in dict(zip(ids.states, run.states, strict=True)).items():
        places = ''.join(f'{process}.{at} ' for process, at in state.locations.items())
        yield _tag('location_vector', id=f'LocVec{number}', locations=places)
        yield _tag('variable_vector', id=f'varvec.{number}', close='>')
        for name, value in state.variables.items():
            written = name if _owner(run, name) else f'sys.{name}'
            yield _tag('variable_state', variable=written, value=value)
        yield '</variable_vector>'
    for index, number in enumerate(ids.states):
        if index + 1 == number:
            yield _tag(
                'node',
                id=f'State{number}',
                location_vector=f'LocVec{number}',
                dbm_instance=f'DBM{1 if run.is_timeless[index] else 2} ',
                variable_vector=f'varvec.{number}',
            )


def _zones(run: UppaalRun) -> Iterator[str]:
    for is_timeless in sorted(set(run.is_timeless), reverse=True):
        yield _tag('dbm_instance', id=f'DBM{1 if is_timeless else 2}', close='>')
        for first in (ZERO, TIME):
            for second in (ZERO, TIME):
                is_open = (first, second) == (TIME, ZERO) and not is_timeless
                bound, comparison = ('inf', '<') if is_open else ('0', '<=')
                yield _tag('clockbound', clock1=first, clock2=second, bound=bound, comp=comparison)
        yield '</dbm_instance>'


def _transitions(run: UppaalRun, ids: _Ids) -> Iterator[str]:
    for index, step in enumerate(run.run.steps):
        edges = (ids.edges[edge.process, run.edge_number(edge)] for edge in step.edges)
        yield _tag(
            'transition',
            **{'from': f'State{ids.states[index]}'},
            to=f'State{ids.states[index + 1]}',
            edges=''.join(f'{edge} ' for edge in edges),
        )


def read_xml(text: str, source: Place) -> tuple[NamedState, ...]:
    """
    Read the states of an XML trace, from its first transition to the last.

    :raises InputError: when it is no such file.
    """
    try:
        if '<!' in text.replace('<![CDATA[', ''):
            raise ValueError('it declares entities or a type')
        root = ElementTree.fromstring(text)
        nodes = {node.attrib['id']: node.attrib for node in root.iter('node')}
        places = {v.attrib['id']: v.attrib['locations'] for v in root.iter('location_vector')}
        values = {
            v.attrib['id']: {x.attrib['variable']: int(x.attrib['value']) for x in v}
            for v in root.iter('variable_vector')
        }
        ids = [root.attrib['initial_node'], *(t.attrib['to'] for t in root.iter('transition'))]
        return tuple(
            _state(places[nodes[i]['location_vector']], values[nodes[i]['variable_vector']])
            for i in ids
        )
    except (KeyError, ValueError, ElementTree.ParseError) as error:
        what = f'no XML trace of UPPAAL ({error})'
        raise InputError(what, source, 'give a file that `verifyta -X` wrote') from None


def _state(locations: str, values: Mapping[str, int]) -> NamedState:
    pairs = (word.rpartition('.') for word in locations.split())
    return NamedState(
        {process: location for process, _, location in pairs},
        {name.removeprefix('sys.'): value for name, value in values.items()},
    )
