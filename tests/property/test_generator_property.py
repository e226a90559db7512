import re
from math import comb
from xml.etree import ElementTree

from closed_specs import closed_specs
from hypothesis import given, settings
from hypothesis.strategies import integers, sampled_from

from ros2cc_extract.generator.build import Text, render
from ros2cc_extract.spec.close import ClosedSpec

INSTANCE = re.compile(r'^(\w+) = (\w+)\(', re.M)


@settings(max_examples=60, deadline=None)
@given(closed_specs(), sampled_from(Text), integers(1, 3))
def test_instances_carry_the_names_of_the_unit(unit: ClosedSpec, text: Text, cycles: int):
    root = ElementTree.fromstring(render(unit, text=text, max_cycle=cycles).xml.encode())
    templates = {template.findtext('name') for template in root.iter('template')}
    instances, _, order = root.findtext('system', '').rpartition('system')
    pairs = dict(INSTANCE.findall(instances))
    names = set(unit.spec.names()) - {unit.spec.name}
    if text is Text.COMPACT:  # nobody but the executor sees readiness, so callbacks do not move
        names -= {callback.name for callback in unit.spec.callbacks}
    assert set(pairs) == names
    assert set(pairs.values()) <= templates
    assert sorted(re.findall(r'\w+', order)) == sorted(names)


@settings(max_examples=60, deadline=None)
@given(closed_specs(), sampled_from(Text))
def test_there_are_as_many_queries_as_the_families_ask_for(unit: ClosedSpec, text: Text):
    model = render(unit, text=text)
    callbacks, groups = len(unit.spec.callbacks), len(unit.spec.groups)
    assert len(model.queries) == 1 + 3 * callbacks + 2 * comb(callbacks, 2) + groups
    assert len(set(model.queries)) == len(model.queries)
    assert model.q.count('/*\n') == len(model.queries)


@settings(max_examples=60, deadline=None)
@given(closed_specs())
def test_both_texts_ask_the_same_questions(unit: ClosedSpec):
    plain, compact = (render(unit, text=text).queries for text in (Text.PLAIN, Text.COMPACT))
    assert [(q.family, q.words, q.callbacks, q.groups) for q in plain] == [
        (q.family, q.words, q.callbacks, q.groups) for q in compact
    ]


@settings(max_examples=30, deadline=None)
@given(closed_specs(), sampled_from(Text))
def test_rendering_twice_gives_the_same_text(unit: ClosedSpec, text: Text):
    assert render(unit, text=text) == render(unit, text=text)
