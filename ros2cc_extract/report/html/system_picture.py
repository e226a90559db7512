"""
The picture of a system: its processes with nodes and executors, and what connects them.

Drawn as one SVG without script: a click on an executor leads to its unit. What a circle of waits
goes through is red; what is not known is dashed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from html import escape

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.report.html.parts import items, span, tag
from ros2cc_extract.report.shared.system_circles import in_circles
from ros2cc_extract.report.shared.system_layout import FROM, columns_of, rows_of
from ros2cc_extract.report.shared.unit_rows import executor_words
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.model import Connection, End, Process, System
from ros2cc_extract.text_escaping import printable

WIDTH, SIDE, MIDDLE = 1080, 330, 270
ROW, GAP, PILL, APART, MOST_APART = 20, 18, 34, 4, 64
_LONGEST = {'process': 40, 'row': 44, 'connection': 34}
_LETTERS = {'topic': 'T', 'service': 'S', 'action': 'A'}
_HEADS = """\
<defs><marker id="to" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" \
orient="auto" markerUnits="userSpaceOnUse"><path d="M0 0L8 4L0 8z"/></marker>\
<marker id="bad-to" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8" markerHeight="8" \
orient="auto" markerUnits="userSpaceOnUse"><path class="circle" d="M0 0L8 4L0 8z"/></marker></defs>
"""
UnitKey = tuple[object, ...]


def unit_key(unit: Spec) -> UnitKey:
    """By which a unit of a process is that of the page."""
    names = tuple(callback.name for callback in unit.callbacks)
    return unit.entry, unit.name, names, len(unit.executor.threads)


def system_section(system: System, anchors: Mapping[UnitKey, str], name: str = 'system') -> str:
    """
    Draw a system.

    :param anchors: of the units that the page holds.
    :param name: anchor of the section.
    """
    system = printable(system)
    counts = f'{len(system.processes)} processes, {len(system.connections)} connections'
    legend = (
        span('letter', 'T'), ' topic ', span('letter', 'S'), ' service ',
        span('letter', 'A'), ' action ', span('circle', 'red: a circle of waits'), ' ',
        span('dashed', 'dashed: not known, or there under a condition'),
    )  # fmt: skip
    return tag(
        'section',
        tag('h2', escape(f'System {system.name}'), ' ', span('quiet', counts)),
        tag('p', *legend, class_='legend'),
        tag('div', _Picture(system, anchors).svg(), class_='system-picture', tabindex='0'),
        _open_facts(system),
        class_='system',
        id=name,
    )


def _open_facts(system: System) -> str:
    facts = dict.fromkeys(
        f'{each.subject}: {each.fact}: {each.reason}' for each in system.unresolved
    )
    if not facts:
        return ''
    title = tag('summary', f'not known: {len(facts)}')
    return tag('details', title, items(map(escape, facts), 'remarks'), class_='open-facts')


@dataclass(frozen=True)
class _Box:
    """Where a process stands; ``rows`` are the heights of its nodes."""

    x: int
    y: int
    height: int
    rows: Mapping[int, int]
    is_left: bool


class _Picture:
    """One drawing."""

    def __init__(self, system: System, anchors: Mapping[UnitKey, str]) -> None:
        self._system = system
        self._anchors = anchors
        self._red = in_circles(system)
        self._processes = {process.name: process for process in system.processes}
        columns = columns_of(system)
        sides = ((columns.left, True), (columns.right, False))
        heights = [
            sum(_height(self._processes[name]) + GAP for name in names) for names, _ in sides
        ]
        self._height = max([*heights, len(columns.connections) * PILL]) + GAP
        self._boxes: dict[str, _Box] = {}
        for (names, is_left), height in zip(sides, heights, strict=True):
            self._place(names, is_left=is_left, top=(self._height - height) // 2)
        number_of = max(1, len(columns.connections))
        step = min(MOST_APART, (self._height - GAP) // number_of)
        top = (self._height - number_of * step + step - PILL) // 2
        self._pills = [
            (connection, top + number * step)
            for number, connection in enumerate(columns.connections)
        ]

    def _place(self, names: tuple[str, ...], *, is_left: bool, top: int) -> None:
        y = top + GAP // 2
        for name in names:
            process = self._processes[name]
            rows = {number: y + ROW * (number + 1) + 18 for number in range(len(process.nodes))}
            x = 0 if is_left else WIDTH - SIDE
            self._boxes[name] = _Box(x, y, _height(process), rows, is_left)
            y += _height(process) + GAP

    def svg(self) -> str:
        """The drawing."""
        parts = [
            *self._arrows(),
            *(self._process(each) for each in self._system.processes),
            *(self._pill(connection, y) for connection, y in self._pills),
        ]
        return (
            f'<svg viewBox="0 0 {WIDTH} {self._height}" width="{WIDTH}" height="{self._height}" '
            f'role="img" aria-label="processes and what connects them">{_HEADS}'
            f'{"".join(parts)}</svg>'
        )

    def _process(self, process: Process) -> str:
        box = self._boxes[process.name]
        is_dashed = process.outside is not None or process.launched.conditional is not None
        frame = (
            f'<rect x="{box.x + 1}" y="{box.y}" width="{SIDE - 2}" height="{box.height}" rx="10"/>'
        )
        title = _text(process.name, box.x + 14, box.y + 20, 'process', 'name')
        rows = [self._node(process, number, box) for number in range(len(process.nodes))]
        y = box.y + ROW * (len(process.nodes) + 1) + 22
        rows += [
            self._unit(unit, box.x + 14, y + number * ROW)
            for number, unit in enumerate(process.units)
        ]
        why = process.outside or process.launched.conditional
        hint = f'<title>{escape(str(why))}</title>' if why is not None else ''
        classes = 'process dashed' if is_dashed else 'process'
        return f'<g class="{classes}">{hint}{frame}{title}{"".join(rows)}</g>'

    def _node(self, process: Process, number: int, box: _Box) -> str:
        name = process.nodes[number].name
        words = 'a node whose name is not known' if isinstance(name, Unknown) else name
        return _text(words, box.x + 14, box.rows[number] + 4, 'row', 'node')

    def _unit(self, unit: Spec, x: int, y: int) -> str:
        words = _text(executor_words(unit.executor), x, y, 'row', 'unit')
        anchor = self._anchors.get(unit_key(unit))
        return f'<a href="#{escape(anchor)}">{words}</a>' if anchor else words

    def _pill(self, connection: Connection, y: int) -> str:
        x = (WIDTH - MIDDLE) // 2
        red = ' circle' if self._is_red(connection) else ''
        types = ', '.join(dict.fromkeys(e.endpoint.type or '?' for e in connection.ends))
        title = f'{connection.what} {connection.name}: {types}'
        return (
            f'<g class="pill {connection.what}{red}"><title>{escape(title)}</title>'
            f'<rect x="{x}" y="{y + 3}" width="{MIDDLE}" height="{PILL - 8}" rx="13"/>'
            f'<text x="{x + 12}" y="{y + 21}" class="what">{_LETTERS[connection.what]}</text>'
            f'{_text(connection.name, x + 30, y + 21, "connection", "name")}</g>'
        )

    def _is_red(self, connection: Connection) -> bool:
        return (connection.what, connection.name) in self._red

    def _arrows(self) -> Iterator[str]:
        """Each once; the red ones last, above the others."""
        found: dict[str, bool] = {}
        for connection, y in self._pills:
            for end in connection.ends:
                is_red = end.process.name in self._red.get((connection.what, connection.name), ())
                found[self._arrow(end, y + PILL // 2 - 1, is_red=is_red)] = is_red
        yield from sorted(found, key=lambda arrow: found[arrow])

    def _arrow(self, end: End, pill_y: int, *, is_red: bool) -> str:
        box = self._boxes[end.process.name]
        number = next(n for n, each in enumerate(end.process.nodes) if each is end.node)
        outer = box.x + SIDE if box.is_left else box.x
        edge = (WIDTH - MIDDLE) // 2
        inner = edge if box.is_left else edge + MIDDLE
        is_from = end.endpoint.kind in FROM
        y = box.rows[number] + (-APART if is_from else APART)
        points = (outer, y, inner, pill_y)
        x1, y1, x2, y2 = points if is_from else (*points[2:], *points[:2])
        bend = (x1 + x2) // 2
        classes = 'arrow circle' if is_red else 'arrow'
        if end.endpoint.conditional:
            classes += ' dashed'
        head = 'bad-to' if is_red else 'to'
        path = f'M{x1} {y1}C{bend} {y1} {bend} {y2} {x2} {y2}'
        return f'<path class="{classes}" d="{path}" marker-end="url(#{head})"/>'


def _height(process: Process) -> int:
    return rows_of(process) * ROW


def _text(text: str, x: int, y: int, kind: str, class_: str) -> str:
    """One line; what is too long for it is in its title."""
    longest = _LONGEST[kind]
    short = text if len(text) <= longest else f'…{text[1 - longest :]}'
    title = f'<title>{escape(text)}</title>' if short != text else ''
    return f'<text x="{x}" y="{y}" class="{class_}">{escape(short)}{title}</text>'
