"""The HTML page: everything in one file, nothing from outside unescaped."""

from __future__ import annotations

import html
import json
import re
from dataclasses import replace
from html import unescape
from html.parser import HTMLParser
from typing import Any

import pytest
from report_samples import CALL, FINDINGS, NOTE, RACE, RUN, at, check_of

from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.promises import Judgement, Mark, Promise
from ros2cc_extract.report.html.page import html_report
from ros2cc_extract.report.shared.checked import Checked
from ros2cc_extract.report.shared.run_lanes import Lane, Stay, lanes_of
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
    When,
)
from ros2cc_extract.verify.results.evidence import Sentence
from ros2cc_extract.verify.results.results import QueryResult, Verdict, Verification

ARM = Spec(
    name='arm',
    callbacks=(
        Callback(
            name='tick',
            type=CallbackType.TMR,
            group='g',
            entity=EntityKind.TIMER,
            period_s=0.5,
            blocking=(Blocking(call='client.call', on='plan'),),
        ),
        Callback(
            name='plan',
            type=CallbackType.CLT,
            group='g',
            entity=EntityKind.CLIENT,
            key=Unknown('<script>alert(1)</script>'),
        ),
        Callback(name='hidden', type=CallbackType.SRV, group='g', builtin=True),
    ),
    groups=(CallbackGroup(name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('<b>')),),
    executor=Executor(name='executor', kind='MultiThreadedExecutor', threads=('thread_0',)),
)
SOURCES = {'src/arm node.py': ''.join(f'line {n} <&>\n' for n in range(1, 60))}
VOID = {'meta', 'input', 'br'}


PROMISES = (
    Judgement(Promise.DEADLOCK, Mark.BROKEN, 'CC101'),
    Judgement(Promise.WAITS, Mark.OPEN, 'a limit of <1> s was hit'),
    Judgement(Promise.RACES, Mark.KEPT),
)
KEPT = (Judgement(Promise.DEADLOCK, Mark.KEPT),)


def arm(*findings: Finding, units: tuple[Spec, ...] = (ARM,), **more: Any) -> Checked:
    """Give the result of a check of ``units``, of which the first breaks a promise."""
    promises = [PROMISES, *[KEPT] * (len(units) - 1)][: len(units)]
    return check_of(
        *findings, **{'units': units, 'promises': promises, 'sources': SOURCES, **more}
    )


def page(*findings: Finding) -> str:
    return html_report(arm(*(findings or FINDINGS)))


class Tree(HTMLParser):
    """Checks that elements are closed in order; collects elements and text."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def parsed(text: str) -> Tree:
    tree = Tree()
    tree.feed(text)
    tree.close()
    return tree


def test_the_page_is_well_formed_and_loads_nothing() -> None:
    tree = parsed(page())
    assert tree.open == []
    names = {name for name, _ in tree.elements}
    assert not names & {'link', 'img', 'iframe'}
    assert not [a for _, a in tree.elements if 'src' in a]
    assert 'url(http' not in page() and '@import' not in page()


def test_what_comes_from_outside_is_escaped() -> None:
    text = page(replace(CALL, message='</script><script>alert(1)</script>'))
    assert '<script>alert' not in text
    assert '</script><script>' not in text.replace('</script>\n<script>', '')
    assert 'not resolved: &lt;b&gt;' in text


def blocks_of(text: str) -> dict[str, list[tuple[int, str]]]:
    """The source lines that the page holds, by the anchors of their files."""
    files = re.findall(r'<details class="file" id="(.*?)">(.*?)</details>', text, re.DOTALL)
    block = r'data-from="(\d+)" tabindex="0">\n(.*?)</pre>'
    return {
        anchor: [(int(first), unescape(lines)) for first, lines in re.findall(block, inner, re.S)]
        for anchor, inner in files
    }


def test_a_finding_leads_to_its_line_and_to_its_rule() -> None:
    text = page(CALL)
    assert (
        '<a class="place" href="#source-0" data-line="40" data-around="2">src/arm node.py:40:9</a>'
        in text
    )
    assert (38, ''.join(f'line {n} <&>\n' for n in range(38, 43))[:-1]) in blocks_of(text)[
        'source-0'
    ]
    assert (
        '<a href="#rule-CC101">CC101 own-group-call: Blocking call into its own callback group</a>'
        in text
    )
    assert 'help: </b>give the client a group' in text


def test_lines_and_rules_and_runs_that_many_show_are_there_once() -> None:
    many = [
        replace(RACE, message=f'race {n}', related=(Remark(at(31), 'here'),)) for n in range(9)
    ]
    text = page(*many)
    assert text.count('<article') == 9
    assert blocks_of(text) == {
        'source-0': [(28, '\n'.join(f'line {n} <&>' for n in range(28, 33)))]
    }
    assert re.findall('<details class="rule" id="(.*?)">', text) == ['rule-CC301']
    assert re.findall('data-run="(.*?)"', text) == ['0'] * 9
    assert len(runs_of(text)['runs']) == 1
    assert text.count('tick: assigned') == 1


def test_a_place_whose_file_is_not_at_hand_is_text() -> None:
    elsewhere = replace(CALL, place=at(99), chain=(), related=())
    text = page(elsewhere)
    assert '<span class="place">src/arm node.py:99:9</span>' in text
    assert blocks_of(text) == {}


def test_findings_stand_by_weight_and_callbacks_link_to_them() -> None:
    tree = parsed(page(RACE, CALL))
    cards = [a['id'] for _, a in tree.elements if (a.get('class') or '').startswith('finding ')]
    badges = [
        a['href']
        for _, a in tree.elements
        if (a.get('class') or '') == 'badge warning' and 'href' in a
    ]
    assert cards == ['finding-1', 'finding-2']
    assert re.findall('<span class="badge (.*?)">(.*?)</span>', page(RACE, CALL))[:2] == [
        ('error', 'CC101'),
        ('warning', 'CC301'),
    ]
    assert badges == ['#finding-2']


def test_a_unit_says_what_is_proven_of_it_and_what_was_found() -> None:
    text = page(RACE, CALL, NOTE)
    said = re.findall(r'<ul class="promises">(.*?)</ul>', text)
    assert said == [
        '<li><span class="broken">✗ no deadlock: CC101</span></li>'
        '<li><span class="undecided">? every wait ends: a limit of &lt;1&gt; s was hit</span></li>'
        '<li><span class="kept">✓ no data race</span></li>'
    ]
    assert re.findall(r'<ul class="links">(.*?)</ul>', text) == [
        '<li><a href="#finding-1">CC101 src/arm node.py:40:9</a></li>'
        '<li><a href="#finding-2">CC301 src/arm node.py:30:9</a></li>'
    ]


def test_the_index_names_the_worst_unit_first() -> None:
    leg, eye = replace(ARM, name='leg'), replace(ARM, name='<eye>', nodes=('eye',))
    given = arm(CALL, units=(leg, eye, ARM), promises=(KEPT, PROMISES[1:], PROMISES))
    text = html_report(given)
    rows = re.findall('<tr><td><a href="(.*?)">(.*?)</a></td>(.*?)</tr>', text)
    assert [(anchor, name) for anchor, name, _ in rows] == [
        ('#unit-2', 'arm'),
        ('#unit-1', '&lt;eye&gt;'),
        ('#unit-0', 'leg'),
    ]
    assert '<td class="broken" title="no deadlock: broken">✗</td>' in rows[0][2]
    assert '<td><span class="badge error">1</span></td>' in rows[0][2]
    assert '<td>multi 1</td><td>3</td>' in rows[0][2]
    assert re.findall('<details class="unit" id="(.*?)"', text) == ['unit-2', 'unit-1', 'unit-0']


def test_one_unit_needs_no_index() -> None:
    assert '<table>' not in page()


@pytest.mark.parametrize(('number', 'opened'), [(3, 3), (4, 0)])
def test_many_units_are_folded(number: int, opened: int) -> None:
    text = html_report(arm(CALL, units=(ARM,) * number))
    assert len(re.findall('<details class="unit" id="unit-[0-9]" open="">', text)) == opened


@pytest.mark.parametrize(('number', 'opened'), [(3, 3), (4, 0)])
def test_many_runs_are_folded(number: int, opened: int) -> None:
    text = page(*[RACE] * number)
    assert text.count('<details class="run" data-run="0" open="">') == opened
    assert text.count('<details class="run" data-run="0"') == number


@pytest.mark.parametrize(('notes', 'folded'), [(10, []), (11, ['11 notes'])])
def test_many_notes_are_folded_below_what_weighs_more(notes: int, folded: list[str]) -> None:
    text = page(*[NOTE] * notes, CALL)
    assert re.findall(r'<details class="notes"><summary>(.*?)</summary>', text) == folded
    kinds = re.findall(r'data-kind="(\w+)"', text)
    assert kinds == ['error', *['note'] * notes]


def test_the_picture_holds_groups_callbacks_and_waits() -> None:
    text = page()
    tree = parsed(text)
    chips = {a['id']: a.get('data-waits') for _, a in tree.elements if a.get('class') == 'chip'}
    assert chips == {'unit-0-0': 'unit-0-1', 'unit-0-1': None}
    assert 'every 0.5 s' in text
    assert 'and 1 entity that rclpy itself adds' in text


def drawn(callback: Callback, group: CallbackGroup) -> str:
    unit = replace(ARM, callbacks=(callback,), groups=(group,))
    return html_report(arm(units=(unit,)))


@pytest.mark.parametrize(
    ('facts', 'said'),
    [
        ({'entity': EntityKind.SUBSCRIPTION}, ['subscription']),
        ({'entity': EntityKind.SUBSCRIPTION, 'key': 'joy'}, ['subscription joy']),
        ({'key': Unknown('a parameter')}, ['timer ?']),
        ({'period_s': 0.5, 'count': 3}, ['timer every 0.5 s × 3']),
        ({'count': Unknown('a loop')}, ['timer × ?']),
        (
            {'conditional': True, 'coroutine': True, 'when': When.LATER},
            ['timer · conditional · created later · coroutine'],
        ),
        ({'one_shot': True, 'library': 'tf2_ros'}, ['timer · one-shot · made by tf2_ros']),
    ],
)
def test_a_callback_is_drawn_with_what_is_known_of_it(
    facts: dict[str, Any], said: list[str]
) -> None:
    tick = replace(ARM.callbacks[0], **{'blocking': (), 'period_s': None, **facts})
    text = drawn(tick, CallbackGroup(name='g', type=GroupType.EXCLUSIVE))
    assert re.findall('<div class="subject">(.*?)</div>', text) == said


@pytest.mark.parametrize(
    ('block', 'said'),
    [
        (Blocking(call='Event.wait'), 'Event.wait'),
        (Blocking(call='client.call', on='plan'), 'client.call → plan'),
        (Blocking(call='client.call', on=Unknown('passed in')), 'client.call'),
        (Blocking(call='time.sleep', seconds=0.5), 'time.sleep 0.5 s'),
        (Blocking(call='time.sleep', seconds=Unknown('a parameter')), 'time.sleep'),
    ],
)
def test_a_wait_is_drawn_with_what_is_known_of_it(block: Blocking, said: str) -> None:
    tick = replace(ARM.callbacks[0], blocking=(block,))
    text = drawn(tick, CallbackGroup(name='g', type=GroupType.EXCLUSIVE))
    assert re.findall('<ul class="waits"><li>(.*?)</li></ul>', text) == [said]


@pytest.mark.parametrize(
    ('group', 'classes', 'name'),
    [
        (CallbackGroup(name='g', type=GroupType.EXCLUSIVE), 'group exclusive', "group 'g'"),
        (CallbackGroup(name='g', type=GroupType.REENTRANT), 'group reentrant', "group 'g'"),
        (
            CallbackGroup(name='g', type=GroupType.REENTRANT, groupless=True),
            'group outside',
            'in no group',
        ),
        (
            CallbackGroup(name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('passed in')),
            'group exclusive unresolved',
            "group 'g'",
        ),
    ],
)
def test_a_group_is_drawn_by_its_kind(group: CallbackGroup, classes: str, name: str) -> None:
    text = html.unescape(drawn(replace(ARM.callbacks[0], blocking=()), group))
    assert re.findall('<section class="(group.*?)"><header><b>(.*?)</b>', text) == [
        (classes, name)
    ]


def runs_of(text: str) -> dict[str, Any]:
    found = re.search('id="runs">(.*?)</script>', text)
    assert found is not None
    return dict(json.loads(found.group(1)))


def test_a_run_is_data_for_the_script_and_text_without_it() -> None:
    text = page(RACE)
    data = runs_of(text)
    words = data['words']
    [[lanes, steps, cycle_from, ends]] = data['runs']
    assert [words[name] for name, _ in lanes] == ['executor', 'thread_0', 'thread_1']
    assert [[words[stay[0]], *stay[1:]] for stay in lanes[1][1]] == [
        ['wait', 0, 1, 1, None],
        ['tick: assigned', 1, 2, 0, 0],
        ['tick: running', 2, 4, 0, 0],
    ]
    says, places, changes = steps[1]
    assert [(words[lane], words[said]) for lane, said in says] == [
        ('thread_0', 'tick starts on thread_0'),
        ('executor', 'executor polls'),
    ]
    assert [words[place] for place in places] == ['src/arm node.py:30:9']
    assert [words[change] for change in changes] == ['n = 1']
    assert (cycle_from, ends) == (2, None)
    assert (
        '<li>from here on, repeated forever: tick starts on thread_0; executor polls '
        '<span class="place">arm node.py:30</span></li>' in text
    )


def test_a_long_run_is_text_in_eight_steps_and_data_in_full() -> None:
    [first, *_] = RUN.moments
    run = replace(
        RUN, moments=tuple(replace(first, number=n) for n in range(1, 31)), cycle_from=None
    )
    text = page(replace(RACE, run=run))
    assert text.count('<li>executor assigns tick') == 8
    assert '(22 steps left out)' in text
    assert '<summary>step through 30 steps</summary>' in text
    assert len(runs_of(text)['runs'][0][1]) == 30


def verification() -> Verification:
    result = QueryResult(
        family='deadlock',
        formula='A[] not <deadlock>',
        words='there is no <deadlock>',
        callbacks=(),
        verdict=Verdict.NOT_SATISFIED,
        reason=None,
        seconds=0.0,
        run=RUN,
    )
    return Verification(
        model='arm',
        profile='rclpy',
        text='compact',
        engine='native',
        states=7,
        transitions=8,
        seconds=0.0,
        peak_mb=0.0,
        complete=True,
        results=(result, replace(result, run=None, verdict=Verdict.UNDECIDED, reason='<late>')),
    )


def test_verdicts_are_there_when_they_are_asked_for() -> None:
    given = arm(RACE, verifications=[verification()])
    assert 'verdict-table' not in parsed_classes(html_report(given))
    text = html_report(replace(given, with_verdicts=True))
    assert 'verdict-table' in parsed_classes(text)
    assert '7 states, 8 transitions, rclpy compact model' in text
    assert '1 not satisfied, 1 undecided' in text
    assert 'there is no &lt;deadlock&gt;' in text
    assert 'undecided (&lt;late&gt;)' in text
    assert re.findall('data-run="(.*?)"', text) == ['0', '0']
    assert parsed(text).open == []


def parsed_classes(text: str) -> set[str]:
    return {a.get('class') or '' for _, a in parsed(text).elements}


def test_what_a_run_says_cannot_end_the_script() -> None:
    evil = Sentence('executor', '</script><!--')
    moment = replace(RUN.moments[0], sentences=(evil,))
    text = page(replace(RACE, run=replace(RUN, moments=(moment,))))
    assert text.count('</script>') == 2
    assert '<!--' not in text
    assert parsed(text).open == []


def test_lanes_have_no_gap_and_name_the_callback() -> None:
    lanes = {lane.process: lane for lane in lanes_of(RUN, ['tick', 'on_reset'])}
    assert lanes['thread_0'] == Lane(
        'thread_0',
        (
            Stay('wait', 0, 1, None, True),
            Stay('assigned', 1, 2, 'tick', False),
            Stay('running', 2, 4, 'tick', False),
        ),
    )
    assert lanes['executor'].stays == (Stay('polling', 0, 4, None, True),)


def test_the_same_input_gives_the_same_bytes() -> None:
    assert page() == page()
