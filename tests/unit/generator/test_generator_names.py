import re
from itertools import chain
from xml.etree import ElementTree

import pytest
from generator_units import every_text

from ros2cc_extract.spec.identifiers import KEYWORDS, MODEL_NAMES

TEXTS = every_text('tick:TMR:a scan:SUB:b', 'a:EXCLUSIVE b:REENTRANT')
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.S)
# A name is declared where a type stands before it and no operator.
DECLARED = re.compile(
    r'\b(?:int|bool|chan|void|CbId|GroupId|ThreadId|CbType|GroupType|\])\s+([A-Za-z_]\w*)\s*[\[;=(,)]'
)
NAMED_TYPE = re.compile(r'\btypedef\s+[^;]*?(\w+)\s*;')


def global_names(xml: str) -> set[str]:
    root = ElementTree.fromstring(xml.encode())
    text = COMMENT.sub('', root.findtext('declaration', ''))
    outside = re.sub(r'\{[^{}]*\}', '{}', re.sub(r'\([^()]*\)', '()', text))
    templates = {template.findtext('name', '') for template in root.iter('template')}
    return templates | {*DECLARED.findall(outside), *NAMED_TYPE.findall(outside)}


@pytest.mark.parametrize('text', TEXTS)
def test_no_unit_may_use_a_name_that_the_model_declares(text: str):
    names = global_names(TEXTS[text])
    assert {'NUM_CB', 'CbId', 'cb_running', 'thread_running', 'Executor'} <= names
    assert names <= MODEL_NAMES


@pytest.mark.parametrize('text', TEXTS)
def test_locations_have_names_that_uppaal_accepts_and_that_are_unique(text: str):
    root = ElementTree.fromstring(TEXTS[text].encode())
    for template in root.iter('template'):
        names = [location.findtext('name', '') for location in template.iter('location')]
        assert all(re.fullmatch(r'[a-z_]+', name) for name in names)
        assert len(set(names)) == len(names)
        assert not KEYWORDS & set(names)


@pytest.mark.parametrize('text', TEXTS)
def test_location_ids_are_unique_in_the_file(text: str):
    root = ElementTree.fromstring(TEXTS[text].encode())
    ids = [location.get('id') for location in root.iter('location')]
    assert len(set(ids)) == len(ids)
    ends = chain(root.iter('source'), root.iter('target'), root.iter('init'))
    assert {end.get('ref') for end in ends} <= set(ids)
