"""
Drawings of a model's automata as UPPAAL shows them, from the coordinates in its XML.

Sizes are those of UPPAAL's editor at 100 %, in its units: text starts at the upper left corner
that the file gives, lines of text follow each other at ``LINE_HEIGHT``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from html import escape
from math import hypot
from xml.etree import ElementTree

from ros2cc_extract.light_dataclasses import dataclass

RADIUS = 11.0
LINE_HEIGHT = 17.0
CHAR_WIDTH = 7.2
_MARGIN = 34.0
_ARROW_LENGTH = 11.0
_ARROW_HALF_WIDTH = 5.0

_COLOURS = {
    'name': '#7d0000',
    'select': '#b38600',
    'guard': '#0f7d0f',
    'synchronisation': '#0a8a9c',
    'assignment': '#1414c8',
    'invariant': '#a0209f',
}


@dataclass(frozen=True)
class Point:
    """A place on the drawing; y grows downwards."""

    x: float
    y: float


@dataclass(frozen=True, kw_only=True)
class Caption:
    """A text on the drawing, with its upper left corner."""

    kind: str
    lines: tuple[str, ...]
    at: Point

    @property
    def width(self) -> float:
        """An estimate from above of the width in UPPAAL's font."""
        return CHAR_WIDTH * max(len(line) for line in self.lines)

    @property
    def height(self) -> float:
        """Height of all lines."""
        return LINE_HEIGHT * len(self.lines)


@dataclass(frozen=True, kw_only=True)
class DrawnLocation:
    """A location; ``mark`` is ``U``, ``C`` or empty."""

    id: str
    at: Point
    mark: str
    initial: bool
    caption: Caption | None


@dataclass(frozen=True, kw_only=True)
class DrawnEdge:
    """An edge; ``line`` runs from the source's centre over the nails to the target's."""

    line: tuple[Point, ...]
    captions: tuple[Caption, ...]


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """What one automaton shows."""

    name: str
    locations: tuple[DrawnLocation, ...]
    edges: tuple[DrawnEdge, ...]

    @property
    def captions(self) -> tuple[Caption, ...]:
        """All texts, those of locations first."""
        named = tuple(location.caption for location in self.locations if location.caption)
        return (*named, *(caption for edge in self.edges for caption in edge.captions))


def draw(xml: str) -> Mapping[str, str]:
    """Draw every template of the model ``xml``: template name to SVG text, in file order."""
    return {drawing.name: _write_svg(drawing) for drawing in read_drawings(xml)}


def read_drawings(xml: str) -> tuple[Drawing, ...]:
    """Collect what UPPAAL would show of each template of the model ``xml``."""
    root = ElementTree.fromstring(xml.encode())
    return tuple(_read_template(template) for template in root.iter('template'))


def _read_template(template: ElementTree.Element) -> Drawing:
    init = template.find('init')
    initial = init.get('ref') if init is not None else None
    locations = tuple(_read_location(item, initial) for item in template.iter('location'))
    places = {location.id: location.at for location in locations}
    return Drawing(
        name=template.findtext('name', ''),
        locations=locations,
        edges=tuple(_read_edge(edge, places) for edge in template.iter('transition')),
    )


def _read_location(location: ElementTree.Element, initial: str | None) -> DrawnLocation:
    committed = location.find('committed') is not None
    urgent = location.find('urgent') is not None
    name = location.find('name')
    return DrawnLocation(
        id=location.get('id', ''),
        at=_read_point(location),
        mark='C' if committed else 'U' if urgent else '',
        initial=location.get('id') == initial,
        caption=_read_caption(name, 'name') if name is not None else None,
    )


def _read_edge(edge: ElementTree.Element, places: Mapping[str, Point]) -> DrawnEdge:
    source, target = (places[_reference(edge, end)] for end in ('source', 'target'))
    nails = (_read_point(nail) for nail in edge.iter('nail'))
    shown = (label for label in edge.iter('label') if label.get('kind') in _COLOURS)
    return DrawnEdge(
        line=(source, *nails, target),
        captions=tuple(_read_caption(label, label.get('kind', '')) for label in shown),
    )


def _reference(edge: ElementTree.Element, end: str) -> str:
    element = edge.find(end)
    return element.get('ref', '') if element is not None else ''


def _read_caption(element: ElementTree.Element, kind: str) -> Caption:
    lines = tuple((element.text or '').strip().splitlines()) or ('',)
    return Caption(kind=kind, lines=lines, at=_read_point(element))


def _read_point(element: ElementTree.Element) -> Point:
    return Point(float(element.get('x', '0')), float(element.get('y', '0')))


def _write_svg(drawing: Drawing) -> str:
    left, top, right, bottom = _bounds(drawing)
    width, height = right - left, bottom - top
    body = '\n'.join(_shapes(drawing))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}" '
        f'viewBox="{left:g} {top:g} {width:g} {height:g}" '
        f'font-family="Helvetica, Arial, sans-serif" font-size="13">\n'
        f'<title>{escape(drawing.name)}</title>\n'
        f'<rect x="{left:g}" y="{top:g}" width="{width:g}" height="{height:g}" fill="white"/>\n'
        f'{body}\n</svg>\n'
    )


def _bounds(drawing: Drawing) -> tuple[float, float, float, float]:
    points = [
        *(location.at for location in drawing.locations),
        *(point for edge in drawing.edges for point in edge.line),
        *(caption.at for caption in drawing.captions),
        *(Point(c.at.x + c.width, c.at.y + c.height) for c in drawing.captions),
    ]
    xs, ys = [point.x for point in points], [point.y for point in points]
    return min(xs) - _MARGIN, min(ys) - _MARGIN, max(xs) + _MARGIN, max(ys) + _MARGIN


def _shapes(drawing: Drawing) -> Iterator[str]:
    for edge in drawing.edges:
        yield from _edge_shapes(edge)
    for location in drawing.locations:
        yield from _location_shapes(location)
    for caption in drawing.captions:
        yield from _caption_shapes(caption)


def _edge_shapes(edge: DrawnEdge) -> Iterator[str]:
    line = _clip(edge.line)
    points = ' '.join(f'{point.x:g},{point.y:g}' for point in line)
    yield f'<polyline points="{points}" fill="none" stroke="#444444"/>'
    yield _arrow_head(line[-2], line[-1])


def _clip(line: tuple[Point, ...]) -> tuple[Point, ...]:
    """Let the line begin and end on the circles instead of in their centres."""
    return (_toward(line[0], line[1], RADIUS), *line[1:-1], _toward(line[-1], line[-2], RADIUS))


def _toward(start: Point, end: Point, distance: float) -> Point:
    length = hypot(end.x - start.x, end.y - start.y) or 1.0
    share = distance / length
    return Point(
        round(start.x + (end.x - start.x) * share, 1),
        round(start.y + (end.y - start.y) * share, 1),
    )


def _arrow_head(before: Point, tip: Point) -> str:
    base = _toward(tip, before, _ARROW_LENGTH)
    share = _ARROW_HALF_WIDTH / _ARROW_LENGTH
    across = Point((tip.y - base.y) * share, (base.x - tip.x) * share)
    corners = (
        tip,
        Point(base.x + across.x, base.y + across.y),
        Point(base.x - across.x, base.y - across.y),
    )
    points = ' '.join(f'{corner.x:.1f},{corner.y:.1f}' for corner in corners)
    return f'<polygon points="{points}" fill="#444444"/>'


def _location_shapes(location: DrawnLocation) -> Iterator[str]:
    at = f'cx="{location.at.x:g}" cy="{location.at.y:g}"'
    yield f'<circle {at} r="{RADIUS:g}" fill="#c5d3ee" stroke="#222222"/>'
    if location.initial:
        yield f'<circle {at} r="{RADIUS - 4:g}" fill="none" stroke="#222222"/>'
    if location.mark:
        yield (
            f'<text x="{location.at.x:g}" y="{location.at.y + 4:g}" text-anchor="middle" '
            f'font-size="11">{location.mark}</text>'
        )


def _caption_shapes(caption: Caption) -> Iterable[str]:
    weight = ' font-weight="bold"' if caption.kind == 'name' else ''
    for number, line in enumerate(caption.lines):
        baseline = caption.at.y + LINE_HEIGHT * number + 13
        yield (
            f'<text x="{caption.at.x:g}" y="{baseline:g}" fill="{_COLOURS[caption.kind]}"'
            f'{weight}>{escape(line)}</text>'
        )
