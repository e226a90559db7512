"""Units in which callbacks spin their executor are decided by slices that have all that spin."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.generator.build import Family, Profile, Query, render
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    CallbackType,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.slices.slicer import Slicer

SINGLE, MULTI = 'SingleThreadedExecutor', 'MultiThreadedExecutor'
AT = Place('arm.py', 1)
SPIN = (
    Blocking(call='executor.spin_until_future_complete', on='executor', source=AT),
    Blocking(call='spin for future', on='reply', source=AT),
)


def unit(*blocking: Blocking, executor: str = SINGLE, rclpy: str = '7.1.6') -> ClosedSpec:
    """``ask`` spins for ``reply``; five subscriptions have nothing to do with either."""
    kinds = {'ask': CallbackType.TMR, 'reply': CallbackType.CLT}
    names = ('ask', 'reply', *(f'data{number}' for number in range(5)))
    callbacks = tuple(
        Callback(
            name=name,
            type=kinds.get(name, CallbackType.SUB),
            group=f'{name}_group',
            node='arm',
            entity=EntityKind.CLIENT if name == 'reply' else None,
            blocking=blocking if name == 'ask' else (),
        )
        for name in names
    )
    groups = tuple(CallbackGroup(name=c.group, type=GroupType.EXCLUSIVE) for c in callbacks)
    threads = ('one',) if executor == SINGLE else ('one', 'two')
    spec = Spec(
        name='arm',
        callbacks=callbacks,
        groups=groups,
        executor=Executor(name='executor', kind=executor, threads=threads, spun='spin'),
        rclpy=rclpy,
    )
    return close(spec)


def sliced(of: ClosedSpec) -> dict[Family, frozenset[str] | None]:
    """The slices of the queries about ``ask``, ``data0`` and the whole unit."""
    queries = render(of, profile=Profile.RCLPY).queries
    slicer = Slicer(of, 1)
    return {
        query.family: slicer.slice_for(query)
        for query in queries
        if query.callbacks in ((), ('data0',), ('ask',), ('data0', 'data1'))
    }


ALL_THAT_WAIT = frozenset({'ask', 'reply'})


@pytest.mark.parametrize(
    ('family', 'others'),
    [
        (Family.NEVER_TOGETHER, {'data0', 'data1'}),
        (Family.CAN_OVERLAP, {'data0', 'data1'}),
        (Family.PROGRESS, set()),
        (Family.DEADLOCK, set()),
        (Family.POOL_EXHAUSTION, set()),
        (Family.ANSWERED_SPIN, set()),
    ],
)
def test_a_slice_has_all_that_spin(family: Family, others: set[str]) -> None:
    assert sliced(unit(*SPIN))[family] == ALL_THAT_WAIT | others


def test_who_starves_is_asked_with_all_that_wait() -> None:
    of = unit(*SPIN)
    starvation = Query(family=Family.STARVATION, formula='', words='', callbacks=('data0',))
    assert Slicer(of, 1).slice_for(starvation) == ALL_THAT_WAIT | {'data0'}


STEP = Blocking(call='executor.spin_once', on='executor', source=AT)
OTHERS = (replace(SPIN[0], call='rclpy.spin_until_future_complete', on='arm'), SPIN[1])


@pytest.mark.parametrize(
    'of',
    [
        pytest.param(unit(*SPIN, executor=MULTI), id='a pool may queue twice'),
        pytest.param(unit(*OTHERS), id='the node leaves its executor'),
        pytest.param(unit(*SPIN, rclpy='7.1.9'), id='a refusal stops the executor'),
    ],
)
def test_no_slice_where_a_spin_concerns_callbacks_that_it_does_not_run(of: ClosedSpec) -> None:
    assert set(sliced(of).values()) == {None}


def test_any_callback_ends_a_spin_once_so_ends_have_no_slice() -> None:
    found = sliced(unit(STEP))
    assert (found[Family.PROGRESS], found[Family.DEADLOCK]) == (None, None)
    assert found[Family.CAN_OVERLAP] == {'ask', 'data0', 'data1'}
