"""Messages that one publishes while another changes them piece by piece."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import DEFAULT, at, exclusive, found, threads, timer, unit

from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.spec.effects import Access, Act
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, Waker

STATE = 'Arm.state'


def sends(*locks: str, name: str = STATE, node: str = 'arm') -> Callback:
    sent = Access(name=name, source=at(20), locks=locks)
    published = (Act(name='state', source=sent.source),)
    facts = {'node': node, 'cls': 'Arm', 'pieces': (sent,), 'publishes': published}
    return timer('send', f'{node}_default', **facts)


def changes(*locks: str, name: str = STATE) -> tuple[Access, ...]:
    return tuple(
        Access(name=name, source=at(line), locks=locks, update=True, in_place=True)
        for line in (30, 31)
    )


def fills(group: str, *locks: str) -> Callback:
    return timer('fill', group, cls='Arm', pieces=changes(*locks))


def thread(*locks: str, **facts: object) -> Activity:
    made = Activity(
        name='fill', kind=ActivityKind.THREAD, node='arm', cls='Arm', pieces=changes(*locks)
    )
    return replace(made, **facts)


OTHER = exclusive('other')
TORN = ['CC301:20 warning']


def said(number: int, group: str, *locks: str) -> list[str]:
    made = unit(threads(number), sends(*locks), fills(group, *locks), groups=(DEFAULT, OTHER))
    return [code for code in found(made) if code.startswith('CC3')]


def test_two_callbacks_that_may_overlap_tear_a_message() -> None:
    assert said(2, 'other') == TORN


@pytest.mark.parametrize(
    ('number', 'group', 'locks'),
    [(1, 'other', ()), (2, 'arm_default', ()), (2, 'other', ('lock',))],
    ids=['one thread', 'one group', 'one lock'],
)
def test_who_cannot_overlap_tears_nothing(number: int, group: str, locks: tuple[str, ...]) -> None:
    assert said(number, group, *locks) == []


def test_a_thread_needs_no_pool_to_tear_it() -> None:
    def codes(activity: Activity, *locks: str) -> list[str]:
        made = replace(unit(threads(1), sends(*locks)), activities=(activity,))
        return [code for code in found(made) if code.startswith('CC3')]

    assert codes(thread()) == TORN
    assert codes(thread('lock'), 'lock') == []
    assert codes(thread('lock'), 'other') == TORN
    before = Waker(by='send', source=at(25))
    assert codes(thread(starts=(before,))) == []


def test_the_finding_names_both_places() -> None:
    made = replace(unit(threads(1), sends()), activities=(thread(),))
    (finding,) = (f for f in findings_of([made], []) if f.code == 'CC301')
    assert finding.message == (
        'send publishes Arm.state while thread fill may change it piece by piece: the message is '
        'half old and half new'
    )
    assert [remark.place.line for remark in finding.related] == [30]
    assert finding.help == 'hold one lock around both; a callback group cannot help'


def test_two_nodes_of_one_class_have_a_message_each() -> None:
    hand = exclusive('hand_default', node='hand')

    def codes(name: str) -> list[str]:
        sender = sends(name=name, node='hand')
        filler = replace(fills('arm_default'), pieces=changes(name=name))
        made = unit(threads(2), sender, filler, groups=(DEFAULT, hand))
        return [code for code in found(made) if code.startswith('CC3')]

    assert codes(STATE) == []
    assert codes('Board.state') == TORN


def test_an_array_that_is_read_whole_is_no_message() -> None:
    made = replace(unit(threads(1), replace(sends(), publishes=())), activities=(thread(),))
    (finding,) = (f for f in findings_of([made], []) if f.code == 'CC301')
    assert finding.message == (
        'send uses all of Arm.state while thread fill may change it piece by piece: it is half '
        'old and half new'
    )
