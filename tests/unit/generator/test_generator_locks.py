"""
Deadlocks by locks that are held over a wait; ``ask`` holds one, ``take`` takes it.

Those of the client's group, and of a spin, run on rclpy 7.1.6 and 9.1.2 (``tests/live``).
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from generator_units import closed_unit
from test_generator_waits import EVENTS, MULTI, SINGLE, stuck

from ros2cc_extract.generator.build import Profile, render
from ros2cc_extract.generator.unit import number_unit
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import RE_ENTRANT, Act, Blocking, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback

CALLBACKS = 'ask:TMR:g reply:CLT:h take:TMR:'
GROUPS = 'g:EXCLUSIVE h:EXCLUSIVE i:EXCLUSIVE r:REENTRANT'
BOTH = ['ask', 'take']
CALL = (Blocking(call='client.call', on='reply'),)
AWAIT = (Blocking(call='await', on='reply'),)
AT = Place('arm.py', 1)
SPIN = (
    Blocking(call='executor.spin_until_future_complete', on='executor', source=AT),
    Blocking(call='spin for future', on='reply', source=AT),
)


def locking(
    waits: tuple[Blocking, ...],
    group: str,
    executor: str,
    threads: int = 1,
    *,
    lock: str = 'lock',
    taken: tuple[Act, ...] = (Act(name='lock'),),
) -> ClosedSpec:
    """``ask`` waits holding ``lock``, and ``take`` of ``group`` takes what ``taken`` says."""
    unit = closed_unit(CALLBACKS + group, GROUPS, threads, executor)
    held = tuple(replace(block, held=(lock,)) for block in waits)

    def with_locks(callback: Callback) -> Callback:
        if callback.name == 'ask':
            return replace(callback, node='arm', blocking=held, locks=(Act(name='lock'),))
        return replace(callback, node='arm', locks=taken if callback.name == 'take' else ())

    callbacks = tuple(map(with_locks, unit.spec.callbacks))
    return replace(unit, spec=replace(unit.spec, callbacks=callbacks))


@pytest.mark.parametrize(
    ('group', 'threads', 'expected'),
    [
        pytest.param('h', 2, BOTH, id='in the group of the client'),
        pytest.param('h', 4, BOTH, id='in the group of the client, more threads'),
        pytest.param('i', 2, BOTH, id='elsewhere, no thread left for the client'),
        pytest.param('i', 3, [], id='elsewhere, a thread left for the client'),
        pytest.param('g', 2, [], id='in the group of the holder'),
        pytest.param('r', 3, [], id='in a reentrant group'),
    ],
)
def test_a_lock_held_over_a_call(group: str, threads: int, expected: list[str]) -> None:
    assert stuck(locking(CALL, group, MULTI, threads)) == expected


@pytest.mark.parametrize('waits', [SPIN, AWAIT], ids=['spin', 'await'])
@pytest.mark.parametrize(('group', 'expected'), [('i', BOTH), ('r', BOTH), ('g', [])])
def test_a_lock_held_while_others_run_on_the_same_thread(
    waits: tuple[Blocking, ...], group: str, expected: list[str]
) -> None:
    assert stuck(locking(waits, group, SINGLE)) == expected


def test_a_lock_held_over_an_await_on_an_executor_that_serves_the_group_meanwhile() -> None:
    assert stuck(locking(AWAIT, 'g', EVENTS)) == BOTH


@pytest.mark.parametrize(
    ('waits', 'group', 'executor', 'threads', 'expected'),
    [
        pytest.param(CALL, 'h', MULTI, 2, BOTH, id='another thread waits'),
        pytest.param(SPIN, 'i', SINGLE, 1, [], id='the same thread takes it again'),
        pytest.param(AWAIT, 'i', SINGLE, 1, [], id='the only thread takes it again'),
    ],
)
def test_a_lock_that_its_holder_may_take_again(
    waits: tuple[Blocking, ...], group: str, executor: str, threads: int, expected: list[str]
) -> None:
    unit = locking(waits, group, executor, threads, lock=f'lock{RE_ENTRANT}')
    assert stuck(unit) == expected


@pytest.mark.parametrize(
    'taken',
    [(), (Act(name='other'),), (Act(name='lock', tries=True),)],
    ids=['none', 'another', 'only tried'],
)
def test_nobody_waits_for_a_lock_that_is_not_taken(taken: tuple[Act, ...]) -> None:
    unit = locking(CALL, 'h', MULTI, 2, taken=taken)
    assert stuck(unit) == []
    assert not number_unit(unit, 1).has_locks


@pytest.mark.parametrize(('name', 'expected'), [('lock', BOTH), ('lock#2', [])])
def test_nodes_may_share_a_lock(name: str, expected: list[str]) -> None:
    unit = locking(CALL, 'h', MULTI, 2, taken=(Act(name=name),))
    ask, reply, take = unit.spec.callbacks
    spec = replace(unit.spec, callbacks=(ask, reply, replace(take, node='leg')))
    assert stuck(replace(unit, spec=spec)) == expected


def test_a_lock_over_two_waits_is_kept_between_them() -> None:
    """With ``take`` waiting for ``ask`` to end, it would be stuck if it got the lock between."""
    unit = locking(CALL * 2, 'i', MULTI, 3)
    ask, reply, take = unit.spec.callbacks
    take = replace(take, blocking=(Blocking(call='Event.wait', on='ask', held=('lock',)),))
    kept = number_unit(replace(unit, spec=replace(unit.spec, callbacks=(ask, reply, take))), 1)
    assert [(wait.lock, sorted(wait.held)) for wait in kept.callbacks[0].waits] == [
        (0, []),
        (None, [0]),
        (None, [0]),
    ]


def test_a_unit_whose_locks_nobody_else_takes_has_the_text_of_one_without() -> None:
    with_locks, without = (
        locking(CALL, 'h', MULTI, 2, taken=()),
        closed_unit(CALLBACKS + 'h', GROUPS, 2, MULTI, 'ask:reply'),
    )
    texts = [render(unit, profile=Profile.RCLPY).xml for unit in (with_locks, without)]
    assert texts[0] == texts[1]


def test_a_lock_that_only_a_thread_holds_while_it_signals_keeps_nobody_out() -> None:
    unit = closed_unit(CALLBACKS + 'i', GROUPS, 2, MULTI)
    signal = Waker(by='thread', held=('lock',))
    wait = Blocking(call='Event.wait', resource='done', wakers=(signal,))
    thread = Activity(
        name='thread',
        kind=ActivityKind.THREAD,
        node='arm',
        blocking=(Blocking(call='Event.wait', resource='begun', wakers=(Waker(by='take'),)),),
    )
    callbacks = tuple(
        replace(each, node='arm', blocking=(wait,) if each.name == 'ask' else ())
        for each in unit.spec.callbacks
    )
    spec = replace(unit.spec, callbacks=callbacks, activities=(thread,))
    assert stuck(replace(unit, spec=spec)) == []
