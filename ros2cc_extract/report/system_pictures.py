"""
Pictures of a system, as DOT for Graphviz and as a Mermaid flowchart.

Processes are boxes around their nodes; topics, services and actions stand between them, with an
arrow from sender or client to receiver or server. What a circle of waits goes through is red.
Several systems are boxes side by side, and nothing connects them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.shared.system_circles import in_circles
from ros2cc_extract.report.shared.system_layout import FROM
from ros2cc_extract.spec.system.model import Connection, Process, System

_SHAPES = {'topic': ('([', '])'), 'service': ('{{', '}}'), 'action': ('[[', ']]')}
_DOT_SHAPES = {'topic': 'ellipse', 'service': 'hexagon', 'action': 'box3d'}
_RED = '#c62828'


@dataclass(frozen=True)
class _Arrow:
    start: str
    end: str
    is_red: bool


class _Picture:
    """
    Identifiers of what is drawn, and the arrows between.

    :param mark: before each identifier, so that those of several systems differ.
    """

    def __init__(self, system: System, mark: str = '') -> None:
        self.system = system
        self.processes = {
            process.name: f'{mark}p{n}' for n, process in enumerate(system.processes)
        }
        self.nodes: dict[tuple[str, int], str] = {}
        for process in system.processes:
            for number, _ in enumerate(process.nodes):
                self.nodes[process.name, number] = f'{mark}n{len(self.nodes)}'
        self.connections = [(f'{mark}c{n}', each) for n, each in enumerate(system.connections)]
        self._red = in_circles(system)

    def is_red(self, connection: Connection, process: Process) -> bool:
        """Whether a circle of waits goes from it to the process, or back."""
        return process.name in self._red.get((connection.what, connection.name), ())

    def arrows(self) -> Iterator[_Arrow]:
        """Each once."""
        found: dict[_Arrow, None] = {}
        for name, connection in self.connections:
            for end in connection.ends:
                number = next(n for n, each in enumerate(end.process.nodes) if each is end.node)
                node = self.nodes[end.process.name, number]
                is_from = end.endpoint.kind in FROM
                pair = (node, name) if is_from else (name, node)
                found[_Arrow(*pair, self.is_red(connection, end.process))] = None
        yield from found


def _pictures(systems: Sequence[System]) -> list[_Picture]:
    if len(systems) == 1:
        return [_Picture(systems[0])]
    return [_Picture(system, f's{number}') for number, system in enumerate(systems)]


def mermaid(systems: Sequence[System]) -> str:
    """Systems as one Mermaid flowchart."""
    pictures = _pictures(systems)
    lines = ['flowchart LR']
    for number, picture in enumerate(pictures):
        own = [f'  {line}' for line in _mermaid_boxes(picture)]
        if len(pictures) > 1:
            own = [f'  {line}' for line in own]
            own = [f'  subgraph s{number}["{_m(picture.system.name)}"]', *own, '  end']
        lines += own
    arrows = [arrow for picture in pictures for arrow in picture.arrows()]
    lines += [f'  {arrow.start} --> {arrow.end}' for arrow in arrows]
    red = [str(number) for number, arrow in enumerate(arrows) if arrow.is_red]
    if red:
        lines.append(f'  linkStyle {",".join(red)} stroke:{_RED},stroke-width:3px')
    return '\n'.join(lines) + '\n'


def _mermaid_boxes(picture: _Picture) -> Iterator[str]:
    """Processes, and what connects them."""
    for process in picture.system.processes:
        outside = ' (outside)' if process.outside is not None else ''
        box = picture.processes[process.name]
        yield f'subgraph {box}["{_m(process.name)}{outside}"]'
        for number, node in enumerate(process.nodes):
            yield f'  {picture.nodes[process.name, number]}["{_m(str(node.name))}"]'
        if not process.nodes:
            yield f'  {box}x[" "]'
        yield 'end'
    for name, connection in picture.connections:
        begin, end = _SHAPES[connection.what]
        yield f'{name}{begin}"{_m(connection.name)}"{end}'


def dot(systems: Sequence[System]) -> str:
    """Systems for Graphviz."""
    pictures = _pictures(systems)
    lines = ['digraph system {', '  rankdir=LR;', '  node [fontname="sans-serif"];']
    for number, picture in enumerate(pictures):
        own = [f'  {line}' for line in _dot_boxes(picture)]
        if len(pictures) > 1:
            name = _d(picture.system.name)
            own = [f'    label={name};', *(f'  {line}' for line in own)]
            own = [f'  subgraph cluster_s{number} {{', *own, '  }']
        lines += own
    for arrow in (arrow for picture in pictures for arrow in picture.arrows()):
        red = f' [color="{_RED}" penwidth=3]' if arrow.is_red else ''
        lines.append(f'  {arrow.start} -> {arrow.end}{red};')
    return '\n'.join([*lines, '}']) + '\n'


def _dot_boxes(picture: _Picture) -> Iterator[str]:
    """Processes, and what connects them."""
    for process in picture.system.processes:
        style = ' style=dashed;' if process.outside is not None else ''
        yield f'subgraph cluster_{picture.processes[process.name]} {{{style}'
        yield f'  label={_d(process.name)};'
        for number, node in enumerate(process.nodes):
            name = picture.nodes[process.name, number]
            yield f'  {name} [shape=box label={_d(str(node.name))}];'
        if not process.nodes:
            yield f'  {picture.processes[process.name]}x [shape=point];'
        yield '}'
    for name, connection in picture.connections:
        shape = _DOT_SHAPES[connection.what]
        yield f'{name} [shape={shape} label={_d(connection.name)}];'


def _m(text: str) -> str:
    """Text that Mermaid takes for nothing else."""
    return re.sub(r'[^\w /~.:()-]', lambda match: f'#{ord(match.group())};', text)


def _d(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"').replace('\n', ' ')
    return f'"{escaped}"'
