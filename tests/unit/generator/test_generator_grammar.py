"""
The XML is what UPPAAL's reader takes, element by element, and declares no word that it reserves.

Order of the elements: the DTD ``flat-1_6`` and UPPAAL's own reader, which reads each kind of child
in its turn (github.com/UPPAALModelChecker/utap, ``xmlreader.cpp``), and the labels of an edge one
after the other: what a ``select`` declares is not known before it.
"""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from generator_units import every_text

from ros2cc_extract.spec.identifiers import KEYWORDS

GOLDEN = Path(__file__).parents[2] / 'golden' / 'models'
TEXTS = {
    **every_text('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT'),
    **{
        f'{path.parent.name}/{path.name}': path.read_text(encoding='utf-8')
        for path in sorted(GOLDEN.glob('*/*.xml'))
    },
}
#: Children of each element in order, one letter each; ``label`` of an edge by its kind.
LETTERS = {
    'declaration': 'd', 'template': 't', 'system': 's', 'queries': 'q', 'name': 'n',
    'parameter': 'p', 'location': 'l', 'init': 'i', 'transition': 'e', 'urgent': 'u',
    'committed': 'c', 'source': 'f', 'target': 't', 'nail': 'b', 'query': 'q', 'formula': 'f',
    'comment': 'c', 'select': 'S', 'guard': 'G', 'synchronisation': 'Y', 'assignment': 'A',
    'comments': 'C',
}  # fmt: skip
ORDER = {
    'nta': 'dt+sq',
    'template': 'np?d?l+ie*',
    'location': 'n?u?c?',
    'transition': 'ftS?G?Y?A?C?b*',
    'queries': 'q*',
    'query': 'fc',
}
REFERENCES = ('init', 'source', 'target')
DECLARED = re.compile(
    r'\b(?:int|bool|chan|void|[A-Z][A-Za-z]+(?:Id|Type|Entry)|\])\s+&?([A-Za-z_]\w*)\s*[\[;=(,):]'
)
SELECTED = re.compile(r'\b(\w+)\s*:\s*(?:int\b|[A-Z])')
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)


def shape(element: ElementTree.Element) -> str:
    kinds = [child.get('kind') if child.tag == 'label' else child.tag for child in element]
    return ''.join(LETTERS.get(kind or '', '?') for kind in kinds)


@pytest.mark.parametrize('text', TEXTS)
def test_children_stand_in_the_order_of_the_dtd(text: str) -> None:
    root = ElementTree.fromstring(TEXTS[text].encode())
    assert root.tag == 'nta'
    for element in root.iter():
        order = ORDER.get(element.tag)
        if order is None:
            assert list(element) == [], element.tag
        else:
            assert re.fullmatch(order, shape(element)), (element.tag, shape(element))


@pytest.mark.parametrize('text', TEXTS)
def test_edges_and_initial_locations_refer_to_locations_of_their_template(text: str) -> None:
    for template in ElementTree.fromstring(TEXTS[text].encode()).iter('template'):
        ids = [location.get('id') for location in template.iter('location')]
        assert len(set(ids)) == len(ids)
        referring = [node for tag in REFERENCES for node in template.iter(tag)]
        assert {node.get('ref') for node in referring} <= set(ids)


@pytest.mark.parametrize('text', TEXTS)
def test_nothing_is_called_like_a_word_of_uppaal(text: str) -> None:
    root = ElementTree.fromstring(TEXTS[text].encode())
    pieces = [
        COMMENT.sub('', node.text or '')
        for tag in ('declaration', 'parameter', 'label', 'system')
        for node in root.iter(tag)
        if node.get('kind') != 'comments'
    ]
    names = {name for piece in pieces for name in DECLARED.findall(piece)}
    names |= {name for piece in pieces for name in SELECTED.findall(piece)}
    assert {'NUM_CB', 'cb_running', 'c'} <= names
    assert not KEYWORDS & names


@pytest.mark.parametrize('text', TEXTS)
def test_a_query_is_one_line_that_only_the_xml_escapes(text: str) -> None:
    for formula in ElementTree.fromstring(TEXTS[text].encode()).iter('formula'):
        words = formula.text or ''
        assert re.match(r'A\[\] |E<> |A<> |E\[\] |.+ --> ', words), words
        assert '\n' not in words
        assert '&' not in words.replace('&&', '')
