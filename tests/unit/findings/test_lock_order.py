"""CC111: locks taken in a circle by callbacks that may meet."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import ONE_THREAD, at, found, only, threads, timer, unit

from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Act
from ros2cc_extract.spec.model import Callback, Executor


def takes(name: str, group: str, *orders: tuple[str, ...]) -> Callback:
    """Each order is the locks held, outermost first, and at last the one that is waited for."""
    locks = [
        Act(name=order[n], source=at(40 + 10 * index + n), held=order[:n])
        for index, order in enumerate(orders)
        for n in range(len(order))
    ]
    return timer(name, group, locks=tuple(locks))


def crossed(one: Callback, other: Callback, executor: Executor | None = None) -> list[str]:
    spec = unit(executor or threads(2), one, other)
    return [f for f in found(spec) if f.startswith('CC111')]


LEFT = takes('left', 'arm_default', ('a', 'b'))
RIGHT = takes('right', 'other', ('b', 'a'))


def test_two_locks_in_opposite_order_are_one_finding_with_both_ways() -> None:
    assert crossed(LEFT, RIGHT) == ['CC111:41']
    finding = only(unit(threads(2), LEFT, RIGHT), 'CC111')
    assert finding.message == (
        'left holds a and waits for b, and right may hold b and wait for a at the same time: '
        'both wait forever'
    )
    assert finding.subjects == ('left', 'right', 'a', 'b')
    assert [remark.text for remark in finding.related] == ['right takes a here, holding b']


@pytest.mark.parametrize(
    'other',
    [
        takes('right', 'other', ('a', 'b')),
        takes('right', 'other', ('b', 'c')),
        takes('right', 'arm_default', ('b', 'a')),
        replace(RIGHT, node=Unknown('passed in')),
    ],
    ids=['same order', 'another lock', 'same group', 'unknown node'],
)
def test_nobody_waits_for_ever_where_they_cannot_cross(other: Callback) -> None:
    assert crossed(LEFT, other) == []


def test_locks_of_two_nodes_cross_as_those_of_one_do() -> None:
    assert crossed(LEFT, replace(RIGHT, node='leg')) == ['CC111:41']


def test_one_thread_takes_locks_one_callback_after_the_other() -> None:
    assert crossed(LEFT, RIGHT, ONE_THREAD) == []


def test_a_third_lock_around_both_keeps_them_apart() -> None:
    one = takes('left', 'arm_default', ('gate', 'a', 'b'))
    other = takes('right', 'other', ('gate', 'b', 'a'))
    assert crossed(one, other) == []
    assert crossed(one, RIGHT) == ['CC111:42']


def test_the_same_two_orders_again_are_no_second_finding() -> None:
    again = takes('right', 'other', ('b', 'a'), ('b', 'a'))
    assert crossed(LEFT, again) == ['CC111:41']


def test_a_lock_taken_twice_is_one_finding_however_often() -> None:
    twice = takes('left', 'arm_default', ('a', 'a'), ('a', 'a'))
    spec = unit(ONE_THREAD, twice)
    assert [f for f in found(spec) if f.startswith('CC111')] == ['CC111:41']
    (where, *_) = only(spec, 'CC111').related
    assert (where.place, where.text) == (at(40), 'a is taken here')


def test_a_lock_that_was_given_back_in_between_is_shown_where_it_is_held() -> None:
    def taking(line: int, *chain: int, held: tuple[str, ...] = ()) -> Act:
        return Act(name='a', source=at(line), chain=tuple(map(at, chain)), held=held)

    once, again = taking(40), taking(50, 42)
    third = taking(60, 42, 52, held=('a',))
    spec = unit(ONE_THREAD, timer('tick', locks=(once, again, third)))
    finding = only(spec, 'CC111')
    assert [each.place for each in finding.related if 'taken' in each.text] == [at(50)]
