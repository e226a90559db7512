"""Closing a unit: every decision is reported."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.errors import IncompleteSpecError
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.close import Policy, close
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)

UNIT = Spec(
    name='arm',
    callbacks=(
        Callback(name='tick', type=CallbackType.TMR, group='g'),
        Callback(name='describe', type=CallbackType.SRV, group='own', builtin=True),
    ),
    groups=(
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE),
        CallbackGroup(name='own', type=GroupType.EXCLUSIVE),
    ),
    executor=Executor(
        name='ex',
        kind='MultiThreadedExecutor',
        threads=('thread_0', 'thread_1'),
        threads_source='default_cpu_count',
    ),
)


def test_built_in_callbacks_and_their_groups_are_folded_out() -> None:
    closed = close(UNIT).spec
    assert [callback.name for callback in closed.callbacks] == ['tick']
    assert [group.name for group in closed.groups] == ['g']


def test_built_in_callbacks_stay_when_asked_for() -> None:
    assert close(UNIT, Policy(builtin=True)).spec.callbacks == UNIT.callbacks


def test_an_assumed_thread_count_is_told() -> None:
    assert close(UNIT).assumptions == (
        'thread count is the number of CPUs at run time; 2 assumed',
    )


def test_a_given_thread_count_is_no_assumption() -> None:
    closed = close(UNIT, Policy(threads=4))
    assert closed.spec.executor.threads == ('thread_0', 'thread_1', 'thread_2', 'thread_3')
    assert closed.assumptions == ()


def test_new_thread_names_avoid_names_that_are_taken() -> None:
    unit = replace(
        UNIT,
        callbacks=(Callback(name='thread_2', type=CallbackType.TMR, group='g'),),
    )
    names = close(unit, Policy(threads=3)).spec.executor.threads
    assert names == ('thread_0', 'thread_1', 'thread_2_2')


def test_a_missing_executor_is_told() -> None:
    unit = replace(UNIT, executor=Executor(name='ex', threads=('t',), kind=Unknown('no spin')))
    assert close(unit).assumptions == ('executor not found (no spin); modelled as one thread',)


def test_a_unit_without_callbacks_cannot_be_modelled() -> None:
    with pytest.raises(IncompleteSpecError, match="unit 'arm' has no callback"):
        close(replace(UNIT, callbacks=UNIT.callbacks[1:]))


def test_every_hole_is_told_in_the_order_of_the_unit() -> None:
    callbacks = (
        Callback(name='loop', type=CallbackType.TMR, group='g', count=Unknown('a range')),
        Callback(name='three', type=CallbackType.TMR, group='g', count=3),
        Callback(name='perhaps', type=CallbackType.TMR, group='h', conditional=True),
        Callback(name='either', type=CallbackType.TMR, group='h', alternative='a.py:3'),
        Callback(name='sure', type=CallbackType.TMR, group='h', assumed='its type (--assume)'),
    )
    groups = (
        CallbackGroup(
            name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('it comes from a parameter')
        ),
        CallbackGroup(name='h', type=GroupType.REENTRANT, assumed='REENTRANT (--assume)'),
    )
    executor = Executor(
        name='ex', kind='Own', threads=('t',), unresolved=Unknown('a class of somebody else')
    )
    unit = replace(UNIT, callbacks=callbacks, groups=groups, executor=executor)
    assert close(unit).assumptions == (
        'executor Own not resolved (a class of somebody else)',
        'group g not resolved (it comes from a parameter); modelled as a group of its own, '
        'EXCLUSIVE',
        'group h: REENTRANT (--assume)',
        'loop is created an unknown number of times; modelled once',
        'three is created 3 times; modelled once',
        'perhaps is created under a condition; modelled as present',
        'either is created under a condition; modelled as present',
        'sure: its type (--assume)',
    )


def test_nothing_is_assumed_of_a_unit_without_holes() -> None:
    unit = replace(UNIT, executor=Executor(name='ex', kind='Own', threads=('t',)))
    assert close(unit).assumptions == ()


def test_a_group_without_callbacks_is_told() -> None:
    spare = CallbackGroup(name='spare', type=GroupType.EXCLUSIVE)
    closed = close(replace(UNIT, groups=(*UNIT.groups, spare)), Policy(threads=4))
    assert [group.name for group in closed.spec.groups] == ['g']
    assert closed.assumptions == ('group spare has no callback, and is not modelled',)
