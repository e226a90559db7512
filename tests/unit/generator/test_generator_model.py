import re
from collections.abc import Callable
from xml.etree import ElementTree

import pytest
from generator_units import closed_unit

from ros2cc_extract.generator.build import Profile, Text, render, render_alone

ARM = closed_unit('tick:TMR:a scan:SUB:b add:SRV:b', 'a:EXCLUSIVE b:REENTRANT', 2)
ALONE = closed_unit('tick:TMR:g', 'g:EXCLUSIVE', 1)


def automata(xml: str) -> dict[str, tuple[int, int]]:
    """Template name to its number of locations and of edges."""
    return {
        template.findtext('name', ''): (
            len(template.findall('location')),
            len(template.findall('transition')),
        )
        for template in ElementTree.fromstring(xml.encode()).iter('template')
    }


def test_plain_text_has_the_published_locations_and_edges():
    assert automata(render(ARM).xml) == {
        'Callback': (2, 2),
        'CallbackGroup': (2, 4),
        'Thread': (4, 4),
        'Executor': (7, 11),
    }


def test_declarations_carry_the_sizes_and_tables_of_the_unit():
    declarations = render(ARM, max_cycle=3).published['arm_declarations.c']
    assert re.findall(r'const int .*', declarations) == [
        'const int NUM_CB = 3;',
        'const int NUM_CB_GROUP = 2;',
        'const int NUM_THREAD = 2;',
        'const int MAX_CYCLE = 3;',
    ]
    assert 'cb_group_table[NUM_CB] = {0, 1, 1};' in declarations
    assert 'cb_type_table[NUM_CB] = {TMR, SUB, SRV};' in declarations


def test_instances_are_the_names_of_the_unit_in_system_order():
    system = render(ARM).published['arm_system.c']
    instances, _, order = system.partition('system\n')
    assert instances.splitlines()[1:] == [
        'tick = Callback(0);',
        'scan = Callback(1);',
        'add = Callback(2);',
        'a = CallbackGroup(EXCLUSIVE, 0);',
        'b = CallbackGroup(REENTRANT, 1);',
        'thread_0 = Thread(0);',
        'thread_1 = Thread(1);',
        'executor = Executor();',
        '',
    ]
    assert order.split() == [
        'executor,', 'thread_0,', 'thread_1,', 'a,', 'b,', 'tick,', 'scan,', 'add;'
    ]  # fmt: skip


def test_model_begins_as_uppaal_writes_it():
    assert render(ALONE).xml.splitlines()[:3] == [
        '<?xml version="1.0" encoding="utf-8"?>',
        "<!DOCTYPE nta PUBLIC '-//Uppaal Team//DTD Flat System 1.6//EN' "
        "'http://www.it.uu.se/research/group/darts/uppaal/flat-1_6.dtd'>",
        '<nta>',
    ]


def test_model_holds_the_text_of_the_published_files():
    model = render(ARM)
    root = ElementTree.fromstring(model.xml.encode())
    assert root.findtext('declaration') == model.published['arm_declarations.c']
    assert root.findtext('system') == model.published['arm_system.c']


def test_model_carries_all_queries_with_their_words():
    model = render(ARM)
    root = ElementTree.fromstring(model.xml.encode())
    assert [
        (query.findtext('formula'), query.findtext('comment')) for query in root.iter('query')
    ] == [(query.formula, query.words) for query in model.queries]


def test_published_files_do_not_depend_on_the_text():
    assert render(ARM, text=Text.PLAIN).published == render(ARM, text=Text.COMPACT).published


@pytest.mark.parametrize('write', [render, render_alone])
def test_a_bound_on_arrivals_below_one_is_refused(write: Callable[..., object]) -> None:
    with pytest.raises(ValueError, match='max_cycle must be at least 1, not 0'):
        write(ALONE, max_cycle=0)


@pytest.mark.parametrize('profile', Profile)
def test_a_model_alone_is_the_same_without_its_queries(profile: Profile) -> None:
    whole = render(ARM, profile=profile, text=Text.COMPACT)
    alone = render_alone(ARM, profile=profile, text=Text.COMPACT)
    assert alone.xml == re.sub(r'(?s)\t\t<query>.*</query>\n', '', whole.xml)
    assert (alone.name, alone.queries) == (whole.name, whole.queries)


def test_without_a_bound_there_is_nothing_to_paste_into_the_published_template():
    model = render(ALONE, max_cycle=None)
    assert model.published == {}
    assert 'MAX_CYCLE' not in model.xml
