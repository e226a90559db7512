"""The HTML page: everything in one file, nothing from outside unescaped."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

import pytest
from report_samples import CALL, FINDINGS, NOTE, RACE, RUN

from ros2cc_extract.report.html.page import html_report
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


def page(*findings: Any) -> str:
    return html_report([ARM], [], findings or FINDINGS, {'files': 2, 'errors': 1}, SOURCES)


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


def test_a_finding_shows_its_line_and_leads_to_its_rule() -> None:
    text = page(CALL)
    assert (
        '<span class="line here"><span class="number">   40</span> line 40 &lt;&amp;&gt;' in text
    )
    assert 'CC101 own-group-call: Blocking call into the own callback group' in text
    assert 'help: </b>give the client a group' in text


def test_findings_stand_by_weight_and_callbacks_link_to_them() -> None:
    tree = parsed(page(RACE, CALL))
    cards = [a['id'] for _, a in tree.elements if (a.get('class') or '').startswith('finding ')]
    links = [a['href'] for name, a in tree.elements if name == 'a']
    assert cards == ['finding-2', 'finding-1']
    assert links == ['#finding-1']


@pytest.mark.parametrize(('notes', 'folded'), [(10, []), (11, ['11 notes'])])
def test_many_notes_are_folded_below_what_weighs_more(notes: int, folded: list[str]) -> None:
    page = html_report([ARM], [], [*[NOTE] * notes, CALL], {'files': 2}, SOURCES)
    assert re.findall(r'<details class="notes"><summary>(.*?)</summary>', page) == folded
    kinds = re.findall(r'data-kind="(\w+)"', page)
    assert kinds == ['error', *['note'] * notes]


def test_the_picture_holds_groups_callbacks_and_waits() -> None:
    text = page()
    tree = parsed(text)
    chips = {a.get('id'): a.get('data-waits') for _, a in tree.elements if 'data-waits' in a}
    assert chips == {'arm-tick': 'arm-plan', 'arm-plan': ''}
    assert 'every 0.5 s' in text
    assert 'and 1 entity that rclpy itself adds' in text


def drawn(callback: Callback, group: CallbackGroup) -> str:
    unit = replace(ARM, callbacks=(callback,), groups=(group,))
    return html_report([unit], [], [], {'files': 1}, {})


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
        (CallbackGroup(name='g', type=GroupType.EXCLUSIVE), 'group exclusive', 'g'),
        (CallbackGroup(name='g', type=GroupType.REENTRANT), 'group reentrant', 'g'),
        (
            CallbackGroup(name='g', type=GroupType.REENTRANT, groupless=True),
            'group outside',
            'in no group',
        ),
        (
            CallbackGroup(name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('passed in')),
            'group exclusive unresolved',
            'g',
        ),
    ],
)
def test_a_group_is_drawn_by_its_kind(group: CallbackGroup, classes: str, name: str) -> None:
    text = drawn(replace(ARM.callbacks[0], blocking=()), group)
    assert re.findall('<section class="(group.*?)"><header><b>(.*?)</b>', text) == [
        (classes, name)
    ]


def test_a_run_is_data_for_the_script_and_text_without_it() -> None:
    text = page(RACE)
    found = re.search('id="runs">(.*?)</script>', text)
    assert found is not None
    (run,) = json.loads(found.group(1))
    assert [lane['name'] for lane in run['lanes']] == ['executor', 'thread_0', 'thread_1']
    assert run['steps'][1] == {
        'says': [['thread_0', 'tick starts on thread_0'], ['executor', 'executor polls']],
        'places': [['tick', 'src/arm node.py:30:9']],
        'changes': ['n = 1'],
    }
    assert run['cycleFrom'] == 2
    assert '<li>from here for ever: tick starts on thread_0; executor polls</li>' in text


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
