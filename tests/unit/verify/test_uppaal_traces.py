"""Runs in UPPAAL's own layouts: written, read again, and replayed to the same states."""

from __future__ import annotations

import pickle
from dataclasses import replace
from xml.etree import ElementTree

import pytest

from ros2cc_extract.checker.api import Model, Query, Run, check, read_model
from ros2cc_extract.checker.runs.printed_runs import NamedState, replay_named
from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.run_evidence import Names, describe
from ros2cc_extract.verify.uppaal.run import UppaalRun
from ros2cc_extract.verify.uppaal.trace_xml import read_xml, to_xml
from ros2cc_extract.verify.uppaal.trace_xtr import read_xtr, to_xtr
from tests.support.published import document
from tests.support.small import automaton

HERE = Place('run')
WALKER = automaton(
    'Walker',
    """rest C:go
    rest -> go; select: k : int[1, 2]; guard: false; do: steps = k
    rest -> go; select: k : int[1, 2]; sync: step!; do: steps = k
    go -> rest; guard: steps > 0; do: last = steps, steps = 0""",
    parameters='const int[0, 1] id',
    local='int[0, 2] last;',
)
WATCH = automaton('Watch', 'on\non -> on; sync: step?; do: seen = 1 - seen')
MODEL_XML = document(
    'int[0, 2] steps; chan step; bool seen;',
    WALKER + WATCH,
    'W = Watch(); system Walker, W;',
).encode()


URGENT_XML = MODEL_XML.replace(b'</name></location>', b'</name><urgent/></location>', 1)


def run_of(formula: str, xml: bytes = MODEL_XML) -> UppaalRun:
    model = read_model(xml.decode(), 'walk.xml')
    result = check(model, [Query(formula, '', None)], reduction=False)
    path = result.answers[0].path
    assert path is not None
    return UppaalRun(model, xml, path)


def states(run: Run) -> list[tuple[dict[str, str], dict[str, int]]]:
    views = [run.initial, *(step.state for step in run.steps)]
    return [(dict(view.locations), dict(view.variables)) for view in views]


def test_xtr_numbers_locations_edges_and_variables_in_the_order_of_the_model() -> None:
    """The edge with a guard that is never true counts too; ``2`` is the value of its select."""
    assert to_xtr(run_of('E<> steps == 2 && Walker(1).go')) == (
        '0 0 0 \n.\n0 1 0\n.\n.\n0 0 0 0 \n.\n'
        '0 1 0 \n.\n0 1 0\n.\n.\n2 1 0 0 \n.\n'
        '1 1 2 ; 2 0 ; .\n'
        '.\n'
    )


def test_xtr_bounds_the_time_while_none_can_have_passed() -> None:
    run = run_of('E<> Walker(0).go', URGENT_XML)
    assert to_xtr(run).count('1 0 0\n.\n') == 2


FORMULAS = (
    'E<> steps == 2 && Walker(1).go',
    'A[] not (Walker(0).go and seen)',
    'Walker(0).go --> Walker(1).go',
    'A<> Walker(1).go',
)


@pytest.mark.parametrize('formula', FORMULAS)
@pytest.mark.parametrize('xml', [MODEL_XML, URGENT_XML], ids=['may rest', 'urgent'])
def test_a_run_that_was_written_is_read_and_replayed(formula: str, xml: bytes) -> None:
    run = run_of(formula, xml)
    query = Query(formula, '', None)
    for read in (
        read_xtr(to_xtr(run), run.model, HERE),
        read_xml(to_xml(run), HERE),
    ):
        again = replay_named(run.model, query, read, HERE)
        assert states(again) == states(run.run)
        assert (again.cycle_start, again.ends) == (run.run.cycle_start, run.run.ends)


def test_xml_lists_what_occurs_and_refers_to_it_by_id() -> None:
    root = ElementTree.fromstring(to_xml(run_of('E<> steps == 2 && Walker(1).go')))
    system = root.find('system')
    assert system is not None
    edges = {e.attrib['id']: [e.attrib['from'], e.attrib['to']] for e in system.iter('edge')}
    assert edges == {
        'Walker(1).Edge1': ['Walker(1).rest', 'Walker(1).go'],
        'W.Edge1': ['W.on', 'W.on'],
    }
    assert [t.attrib for t in root.iter('transition')] == [
        {'from': 'State1', 'to': 'State2', 'edges': 'Walker(1).Edge1 W.Edge1 '}
    ]
    assert [label.text for label in system.iter('sync')] == ['step!', 'step?']
    bounds = [b.get('bound') for b in root.iter('clockbound')]
    assert bounds == ['0', '0', 'inf', '0']


def test_xml_of_a_cycle_leads_back_to_its_first_state() -> None:
    run = run_of('Walker(0).go --> Walker(1).go', URGENT_XML)
    root = ElementTree.fromstring(to_xml(run))
    assert run.run.cycle_start is not None
    last = list(root.iter('transition'))[-1]
    assert last.attrib['to'] == f'State{run.run.cycle_start + 1}'


def test_an_xtr_of_older_versions_has_a_line_per_edge() -> None:
    run = run_of('E<> steps == 2 && Walker(1).go')
    old = to_xtr(run).replace('1 1 2 ; 2 0 ; .\n', '1 2 2\n2 1\n.\n')
    assert read_xtr(old, run.model, HERE) == read_xtr(to_xtr(run), run.model, HERE)


def model() -> Model:
    return read_model(MODEL_XML.decode(), 'walk.xml')


@pytest.mark.parametrize(
    ('text', 'complaint'),
    [
        ('', 'the file ends within the run'),
        ('0 0 \n.\n', "3 numbers expected, found '0 0'"),
        ('--0 0 0 \n.\n', "3 numbers expected, found '--0 0 0'"),
        ('0 0 x\n.\n', "3 numbers expected, found '0 0 x'"),
        ('0 9 0\n.\n.\n0 0 0 0\n.\n.\n', r'process Walker\(1\) has no location 9'),
        ('0 0 0\n0 0 0\n', "a dot expected, found '0 0 0'"),
    ],
)
def test_an_xtr_that_is_not_of_the_model_is_refused(text: str, complaint: str) -> None:
    with pytest.raises(InputError, match=f'run: {complaint}; give an .xtr that UPPAAL saved'):
        read_xtr(text, model(), HERE)


@pytest.mark.parametrize(
    'text',
    [
        '<trace/>',
        '<trace initial_node="S"/>',
        'none',
        '<!DOCTYPE trace [<!ENTITY a "b">]><trace initial_node="&a;"/>',
    ],
)
def test_xml_that_is_no_trace_is_refused(text: str) -> None:
    with pytest.raises(InputError, match='no XML trace of UPPAAL'):
        read_xml(text, HERE)


@pytest.mark.parametrize(
    ('named', 'complaint'),
    [
        ([], 'the run does not begin in the initial state'),
        ([{'W': 'off'}], 'the run does not begin in the initial state'),
        ([{'W': 'on'}, {'Walker(0)': 'gone'}], 'step 1 is no transition'),
        ([{'W': 'on'}, {'Walker(0)': 'go'}, {'Walker(1)': 'go'}], 'step 2 is no transition'),
    ],
)
def test_a_run_of_another_model_is_refused(named: list[dict[str, str]], complaint: str) -> None:
    printed = [NamedState(locations, {}) for locations in named]
    with pytest.raises(InputError, match=complaint):
        replay_named(model(), Query('E<> true', '', None), printed, HERE)


def test_a_told_run_travels_without_its_model() -> None:
    run = run_of('E<> seen')
    told = replace(describe(run.run, Names()), origin=run)
    again = pickle.loads(pickle.dumps(told))
    assert (again, again.origin) == (told, None)


def test_edges_on_one_line_cannot_be_told_apart() -> None:
    xml = MODEL_XML.replace(b'\n', b' ')
    read = read_model(xml.decode(), 'walk.xml')
    path = check(read, [Query('E<> seen', '', None)]).answers[0].path
    assert path is not None
    with pytest.raises(InputError, match='edges rest -> go stand on one line'):
        to_xtr(UppaalRun(read, xml, path))
