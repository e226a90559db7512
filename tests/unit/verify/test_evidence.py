"""Runs described in the words of the model's own comments."""

from __future__ import annotations

from ros2cc_extract.checker.api import Query, Run, check, read_model
from ros2cc_extract.report.trace_formats import STEP_US, chrome_trace, mermaid
from ros2cc_extract.source_locations import Place
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Sentence
from ros2cc_extract.verify.results.run_evidence import Names, describe

COMMENTED = """<?xml version="1.0" encoding="utf-8"?>
<nta><declaration>int[0,2] n; chan go;</declaration>
<template><name>T</name><parameter>const int id</parameter>
<declaration>int[0,1] mine;</declaration>
<location id="id0"><name>idle</name></location>
<location id="id1"><name>busy</name></location>
<location id="id2"><name>over</name></location><init ref="id0"/>
<transition><source ref="id0"/><target ref="id1"/>
<label kind="synchronisation">go!</label>
<label kind="assignment">mine = 1, n = n + 1</label>
<label kind="comments">event start; who: callback mine;
  thread: thread id</label></transition>
<transition><source ref="id1"/><target ref="id2"/>
<label kind="assignment">n = n + 1</label></transition>
<transition><source ref="id2"/><target ref="id2"/>
<label kind="comments">event close; group: group 7</label></transition>
</template>
<template><name>R</name><location id="id9"><name>w</name></location><init ref="id9"/>
<transition><source ref="id9"/><target ref="id9"/>
<label kind="synchronisation">go?</label></transition></template>
<system>t0 = T(0); r = R(); system t0, r;</system></nta>
"""
NAMES = Names(('a', 'b'), ('worker',), ('g',), 'ex', {'b': Place('arm.py', 4)})


def run_of(formula: str, xml: str = COMMENTED) -> Run:
    result = check(read_model(xml, 'm.xml'), [Query(formula, '', None)])
    path = result.answers[0].path
    assert path is not None
    return path


def test_expressions_are_evaluated_after_the_step() -> None:
    evidence = describe(run_of('E<> t0.busy'), NAMES)
    (moment,) = evidence.moments
    assert moment.sentences == (
        Sentence('t0', 'b starts on worker', Event(kind='start', who='b', thread='worker')),
    )
    assert moment.places == (('b', Place('arm.py', 4)),)
    assert moment.changes == {'t0': 'busy', 'n': 1, 't0.mine': 1}
    assert evidence.start == {'t0': 'idle', 'r': 'w'}


def test_steps_without_words_are_passed_over_and_their_changes_kept() -> None:
    evidence = describe(run_of('(t0.busy) --> (t0.busy and n == 2)'), NAMES)
    texts = [[sentence.text for sentence in moment.sentences] for moment in evidence.moments]
    assert texts == [['b starts on worker']]
    assert evidence.ends == 'idle'


def test_a_cycle_starts_at_its_first_told_step() -> None:
    run = run_of(
        'A<> n == 0 and t0.busy',
        COMMENTED.replace(
            '<location id="id2"><name>over</name>', '<location id="id2"><name>over</name><urgent/>'
        )
        .replace(
            '<location id="id0"><name>idle</name>', '<location id="id0"><name>idle</name><urgent/>'
        )
        .replace(
            '<location id="id1"><name>busy</name>', '<location id="id1"><name>busy</name><urgent/>'
        ),
    )
    evidence = describe(run, NAMES)
    assert [m.sentences[0].text for m in evidence.moments] == [
        'b starts on worker',
        'group group 7 closes',
    ]
    assert evidence.cycle_from == 2


def test_a_model_without_words_is_told_by_its_locations() -> None:
    bare = '\n'.join(line for line in COMMENTED.splitlines() if 'event start' not in line)
    bare = bare.replace('  thread: thread id</label></transition>', '</transition>')
    bare = bare.replace('<label kind="comments">event close; group: group 7</label>', '')
    evidence = describe(run_of('E<> t0.busy', bare), NAMES)
    assert [sentence.text for sentence in evidence.moments[0].sentences] == [
        't0: idle -> busy (go)',
        'r: w -> w (go)',
    ]


def test_mermaid_draws_an_arrow_from_sender_to_receiver() -> None:
    bare = COMMENTED.replace('event start; who: callback mine;', 'says; "hello" #1')
    bare = bare.replace('event close; group: group 7', '').replace(
        'thread: thread id', 'on worker'
    )
    chart = mermaid(describe(run_of('E<> t0.busy', bare), NAMES), 'why; "so"')
    assert chart == (
        '---\ntitle: "why, \'so\'"\n---\nsequenceDiagram\n    participant t0\n    participant r\n'
        "    t0->>r: 1. t0: says, 'hello' no. 1 on worker<br/>r: w -> w (go)\n"
    )


def test_mermaid_gets_other_names_for_what_it_would_read_as_signs() -> None:
    indexed = COMMENTED.replace('const int id', 'const int[0,0] id').replace('t0 = T(0); ', '')
    indexed = indexed.replace('system t0, r;', 'system T, r;').replace('event ', 'the event ')
    chart = mermaid(describe(run_of('E<> T(0).busy', indexed), Names()), 'why')
    assert chart.splitlines()[4:] == [
        '    participant p0 as T(0)',
        '    participant r',
        '    p0->>r: 1. T(0): the event start, who: callback mine, thread: thread id<br/>'
        'r: w -> w (go)',
    ]


def test_chrome_trace_has_a_track_per_process_and_a_slice_per_stay() -> None:
    trace = chrome_trace(describe(run_of('E<> t0.busy'), NAMES), 'title')
    slices = [
        (event['tid'], event['name'], event['ts'], event['dur'])
        for event in trace['traceEvents']
        if event['ph'] == 'X'
    ]
    assert slices == [
        (1, 'idle', 0, STEP_US),
        (1, 'busy: b', STEP_US, STEP_US),
        (2, 'w', 0, 2 * STEP_US),
    ]
    names = [e['args']['name'] for e in trace['traceEvents'] if e['name'] == 'thread_name']
    assert names == ['t0', 'r']
