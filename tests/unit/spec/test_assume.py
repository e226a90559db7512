"""What the user says about holes fills holes, and nothing that is known."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.assumptions import DEFAULT_COUNT, Assumptions, assume, read_assumptions
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    Executor,
    GroupType,
    Spec,
)

MULTI = 'MultiThreadedExecutor'
KNOWN = Executor(name='ex', kind=MULTI, threads=('thread_0', 'thread_1'))
LOST = Executor(
    name='ex', kind=Unknown('no spin'), threads=('thread_0',), unresolved=Unknown('no spin')
)
ALL = Assumptions(
    threads=3, executor='SingleThreadedExecutor', rclpy='7.1.6', groups={'g': GroupType.REENTRANT}
)


def unit(executor: Executor, group: CallbackGroup | None = None) -> Spec:
    return Spec(
        name='arm',
        callbacks=(Callback(name='tick', type=CallbackType.TMR, group='g'),),
        groups=(group or CallbackGroup(name='g', type=GroupType.EXCLUSIVE),),
        executor=executor,
    )


def test_entries_are_read_and_a_later_one_wins() -> None:
    entries = ['threads=4', 'executor=Own', 'rclpy=9.1.2', 'group.g=EXCLUSIVE', 'threads=2']
    assert read_assumptions(entries) == Assumptions(
        threads=2, executor='Own', rclpy='9.1.2', groups={'g': GroupType.EXCLUSIVE}
    )


@pytest.mark.parametrize(
    'entry',
    [
        'threads',
        'threads=0',
        'threads=-1',
        'threads=two',
        'threads=\u00b2',
        'executor=',
        'executor=a b',
        'rclpy=7.1',
        'rclpy=foxy',
        'group.g',
        'group.g=exclusive',
        'groups.g=EXCLUSIVE',
        '',
    ],
)
def test_an_entry_of_another_form_is_refused(entry: str) -> None:
    with pytest.raises(InputError) as raised:
        read_assumptions([entry], Place('pyproject.toml', 3))
    assert str(raised.value) == (
        f'pyproject.toml:3: assumption {entry!r} is not understood; write threads=N, '
        'executor=CLASS, rclpy=X.Y.Z|DISTRO or group.NAME=EXCLUSIVE|REENTRANT'
    )


def test_what_is_known_stays() -> None:
    known = replace(unit(KNOWN), rclpy='9.1.2')
    assert assume(known, ALL) is known


def test_without_an_assumption_holes_stay() -> None:
    lost = unit(LOST, CallbackGroup(name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('?')))
    assert assume(lost, Assumptions()) == lost


def test_a_lost_executor_gets_its_class_and_threads() -> None:
    executor = assume(unit(LOST), ALL).executor
    assert executor == Executor(
        name='ex',
        kind='SingleThreadedExecutor',
        threads=('thread_0', 'thread_1', 'thread_2'),
        threads_source='assumed',
        assumed='threads=3 (--assume)',
    )


def test_a_default_count_of_threads_is_a_hole() -> None:
    default = replace(KNOWN, threads_source=DEFAULT_COUNT)
    executor = assume(unit(default), Assumptions(threads=1)).executor
    assert (executor.kind, executor.threads) == (MULTI, ('thread_0',))


def test_only_a_group_that_was_not_followed_is_assumed() -> None:
    lost = CallbackGroup(name='g', type=GroupType.EXCLUSIVE, unresolved=Unknown('a parameter'))
    (group,) = assume(unit(KNOWN, lost), ALL).groups
    assert (group.type, group.unresolved) == (GroupType.REENTRANT, None)
    assert group.assumed == 'group.g=REENTRANT (--assume)'
    assert assume(unit(KNOWN), ALL).groups == unit(KNOWN).groups


def test_a_release_is_assumed_where_none_was_recorded() -> None:
    assert assume(unit(KNOWN), ALL).rclpy == '7.1.6'
