"""
Pictures of a system, as DOT for Graphviz and as a Mermaid flowchart.

Processes are boxes around their nodes; topics, services and actions stand between them, with an
arrow from who sends or asks to who takes or answers. What a circle of waits goes through is red.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

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
    """Identifiers of what is drawn, and the arrows between."""

    def __init__(self, system: System) -> None:
        self.processes = {process.name: f'p{n}' for n, process in enumerate(system.processes)}
        self.nodes: dict[tuple[str, int], str] = {}
        for process in system.processes:
            for number, _ in enumerate(process.nodes):
                self.nodes[process.name, number] = f'n{len(self.nodes)}'
        self.connections = [(f'c{n}', each) for n, each in enumerate(system.connections)]
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


def mermaid(system: System) -> str:
    """The system as a Mermaid flowchart."""
    picture = _Picture(system)
    lines = ['flowchart LR']
    for process in system.processes:
        outside = ' (outside)' if process.outside is not None else ''
        box = picture.processes[process.name]
        lines.append(f'  subgraph {box}["{_m(process.name)}{outside}"]')
        for number, node in enumerate(process.nodes):
            lines.append(f'    {picture.nodes[process.name, number]}["{_m(str(node.name))}"]')
        if not process.nodes:
            lines.append(f'    {box}x[" "]')
        lines.append('  end')
    for name, connection in picture.connections:
        begin, end = _SHAPES[connection.what]
        lines.append(f'  {name}{begin}"{_m(connection.name)}"{end}')
    red = []
    for number, arrow in enumerate(picture.arrows()):
        lines.append(f'  {arrow.start} --> {arrow.end}')
        red += [str(number)] if arrow.is_red else []
    if red:
        lines.append(f'  linkStyle {",".join(red)} stroke:{_RED},stroke-width:3px')
    return '\n'.join(lines) + '\n'


def dot(system: System) -> str:
    """The system for Graphviz."""
    picture = _Picture(system)
    lines = ['digraph system {', '  rankdir=LR;', '  node [fontname="sans-serif"];']
    for process in system.processes:
        style = ' style=dashed;' if process.outside is not None else ''
        lines.append(f'  subgraph cluster_{picture.processes[process.name]} {{{style}')
        lines.append(f'    label={_d(process.name)};')
        for number, node in enumerate(process.nodes):
            name = picture.nodes[process.name, number]
            lines.append(f'    {name} [shape=box label={_d(str(node.name))}];')
        if not process.nodes:
            lines.append(f'    {picture.processes[process.name]}x [shape=point];')
        lines.append('  }')
    for name, connection in picture.connections:
        shape = _DOT_SHAPES[connection.what]
        lines.append(f'  {name} [shape={shape} label={_d(connection.name)}];')
    for arrow in picture.arrows():
        red = f' [color="{_RED}" penwidth=3]' if arrow.is_red else ''
        lines.append(f'  {arrow.start} -> {arrow.end}{red};')
    return '\n'.join([*lines, '}']) + '\n'


def _m(text: str) -> str:
    """Text that Mermaid takes for nothing else."""
    return re.sub(r'[^\w /~.:()-]', lambda match: f'#{ord(match.group())};', text)


def _d(text: str) -> str:
    escaped = text.replace('\\', '\\\\').replace('"', '\\"').replace('\n', ' ')
    return f'"{escaped}"'
