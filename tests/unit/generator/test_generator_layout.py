"""What the editor shows must be legible: nothing is drawn over anything else."""

from itertools import combinations

import pytest
from generator_units import closed_unit, every_text

from ros2cc_extract.generator.build import render
from ros2cc_extract.generator.svg import (
    RADIUS,
    Caption,
    Drawing,
    Point,
    draw,
    read_drawings,
)

ARM = ('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT')
DRAWINGS = [
    pytest.param(drawing, id=f'{text}-{drawing.name}')
    for text, xml in every_text(*ARM).items()
    for drawing in read_drawings(xml)
]
Box = tuple[float, float, float, float]


def box(caption: Caption) -> Box:
    at = caption.at
    return at.x, at.y, at.x + caption.width, at.y + caption.height


def circle(at: Point) -> Box:
    return at.x - RADIUS, at.y - RADIUS, at.x + RADIUS, at.y + RADIUS


def overlap(a: Box, b: Box) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def crosses(start: Point, end: Point, area: Box) -> bool:
    """Whether any of 200 points of the line lies in the area."""
    return any(
        area[0] < start.x + (end.x - start.x) * step / 200 < area[2]
        and area[1] < start.y + (end.y - start.y) * step / 200 < area[3]
        for step in range(201)
    )


@pytest.mark.parametrize('drawing', DRAWINGS)
def test_texts_do_not_overlap_each_other(drawing: Drawing):
    for a, b in combinations(drawing.captions, 2):
        assert not overlap(box(a), box(b)), (a.lines, b.lines)


@pytest.mark.parametrize('drawing', DRAWINGS)
def test_texts_do_not_cover_locations(drawing: Drawing):
    for caption in drawing.captions:
        for location in drawing.locations:
            assert not overlap(box(caption), circle(location.at)), (caption.lines, location.id)


@pytest.mark.parametrize('drawing', DRAWINGS)
def test_edges_do_not_run_through_texts(drawing: Drawing):
    for edge in drawing.edges:
        for start, end in zip(edge.line, edge.line[1:], strict=False):
            for caption in drawing.captions:
                assert not crosses(start, end, box(caption)), (caption.lines, start, end)


@pytest.mark.parametrize('drawing', DRAWINGS)
def test_edges_do_not_run_through_other_locations(drawing: Drawing):
    for edge in drawing.edges:
        for location in drawing.locations:
            if location.at not in (edge.line[0], edge.line[-1]):
                for start, end in zip(edge.line, edge.line[1:], strict=False):
                    assert not crosses(start, end, circle(location.at)), (location.id, start)


@pytest.mark.parametrize('drawing', DRAWINGS)
def test_rows_are_straight(drawing: Drawing):
    """Locations that are nearly in a row or column are exactly so."""
    for a, b in combinations(drawing.locations, 2):
        assert a.at.x == b.at.x or abs(a.at.x - b.at.x) > 2 * RADIUS
        assert a.at.y == b.at.y or abs(a.at.y - b.at.y) > 2 * RADIUS


def test_drawing_shows_marks_names_and_labels():
    picture = draw(render(closed_unit(*ARM, 2)).xml)['Thread']
    assert picture.count('>C</text>') == 2
    assert picture.count('>U</text>') == 1
    assert picture.count('<circle') == 4 + 1
    assert picture.count('<polygon') == 4
    assert '#0a8a9c">cb_assign_signal[id]?</text>' in picture
    assert '#1414c8">take_assignment()</text>' in picture
    assert 'starts on' not in picture


def test_drawing_escapes_what_xml_reserves():
    assert 'cycle_count &lt; MAX_CYCLE' in draw(render(closed_unit(*ARM, 2)).xml)['Callback']
