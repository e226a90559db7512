"""Which callbacks a query of a unit depends on, and what a slice of them looks like."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

from ros2cc_extract.generator.build import Family, Query
from ros2cc_extract.spec.close import ClosedSpec, close
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from ros2cc_extract.verify.slices.slice_shapes import Shape, outline_of
from ros2cc_extract.verify.slices.slicer import Slicer

KINDS = {
    'tick': EntityKind.TIMER,
    'ask': EntityKind.SUBSCRIPTION,
    'busy': EntityKind.SUBSCRIPTION,
    'watch': EntityKind.SUBSCRIPTION,
    'far': EntityKind.SUBSCRIPTION,
    'client': EntityKind.CLIENT,
    'plan': EntityKind.SERVICE,
}
GROUPS = {'tick': 'g0', 'ask': 'g1', 'busy': 'g1', 'client': 'g2', 'watch': 'g2', 'plan': 'g3'}
#: ``ask`` calls a service through ``client``; ``watch`` waits in the group of that.
WAITS = {
    'ask': Blocking(call='client.call', on='client'),
    'watch': Blocking(call='Event.wait', on='far'),
}


def callback(name: str) -> Callback:
    kind = KINDS[name]
    return Callback(
        name=name,
        type=kind.published_type,
        entity=kind,
        group=GROUPS.get(name, 'g4'),
        key='make_plan' if kind in (EntityKind.CLIENT, EntityKind.SERVICE) else None,
        blocking=(WAITS[name],) if name in WAITS else (),
    )


def unit(
    *names: str, threads: int = 4, reentrant: Sequence[str] = (), kind: str = 'MultiThreaded'
) -> ClosedSpec:
    callbacks = tuple(callback(name) for name in names or KINDS)
    groups = dict.fromkeys(each.group for each in callbacks)
    return close(
        Spec(
            name='unit',
            callbacks=callbacks,
            groups=tuple(
                CallbackGroup(
                    name=group,
                    type=GroupType.REENTRANT if group in reentrant else GroupType.EXCLUSIVE,
                )
                for group in groups
            ),
            executor=Executor(
                name='executor',
                kind=f'{kind}Executor',
                threads=tuple(f't{number}' for number in range(threads)),
            ),
        )
    )


def query(family: Family, *callbacks: str, groups: Sequence[str] = ()) -> Query:
    return Query(family=family, formula='', words='', callbacks=callbacks, groups=tuple(groups))


def slice_for(asked: Query, closed: ClosedSpec | None = None) -> set[str] | None:
    found = Slicer(closed or unit(), max_cycle=1).slice_for(asked)
    return None if found is None else set(found)


CALL = {'ask', 'client', 'plan'}


@pytest.mark.parametrize(
    ('asked', 'names'),
    [
        (query(Family.NEVER_TOGETHER, 'tick', 'far'), {'tick', 'far'}),
        (query(Family.NEVER_TOGETHER, 'busy', 'far'), {'busy', 'far'}),
        (query(Family.NEVER_TOGETHER, 'ask', 'tick'), CALL | {'tick'}),
        (query(Family.SELF_OVERLAP, 'plan'), CALL),
        (query(Family.SELF_OVERLAP, 'watch'), {'watch', 'far'}),
        (query(Family.OUTSIDE_GROUPS, 'tick', groups=['g1']), CALL | {'tick', 'busy'}),
        (query(Family.PROGRESS, 'watch'), {'watch', 'far'}),
        (query(Family.PROGRESS, 'ask'), CALL | {'watch', 'far'}),
        (query(Family.STARVATION, 'tick'), {'tick'}),
        (query(Family.STARVATION, 'busy'), set(KINDS) - {'tick'}),
        (query(Family.DEADLOCK), None),
        (query(Family.SERIAL), None),
        (query(Family.POOL_EXHAUSTION), None),
    ],
    ids=lambda value: (
        f'{value.family.value}-{"-".join(value.callbacks)}' if isinstance(value, Query) else ''
    ),
)
def test_a_slice_has_all_that_decide(asked: Query, names: set[str] | None) -> None:
    assert slice_for(asked) == names


def test_a_reentrant_group_is_never_closed() -> None:
    asked = query(Family.OUTSIDE_GROUPS, 'tick', groups=['g1'])
    assert slice_for(asked, unit(reentrant=['g1'])) == CALL | {'tick'}


ENDS = query(Family.PROGRESS, 'watch')


@pytest.mark.parametrize(
    ('closed', 'is_sliced'),
    [
        (unit(threads=3), True),
        (unit(threads=2), False),
        (unit(threads=2, reentrant=['g1']), False),
        (unit('ask', 'client', 'plan', threads=2), True),
        (unit('ask', 'client', 'plan', threads=1), False),
        (unit(threads=4, kind='SingleThreaded'), False),
        (unit('tick', 'far', threads=1), True),
    ],
    ids=['spare', 'none', 'none_of_a_reentrant_group', 'one_waits', 'alone', 'no_pool', 'no_wait'],
)
def test_an_end_has_a_slice_if_a_thread_is_free_whoever_waits(
    closed: ClosedSpec, is_sliced: bool
) -> None:
    name = closed.spec.callbacks[0].name
    assert (slice_for(query(Family.PROGRESS, name), closed) is not None) is is_sliced


def test_each_arrival_of_a_reentrant_group_may_hold_a_thread() -> None:
    closed = unit('watch', 'far', threads=3, reentrant=['g2'])
    assert [Slicer(closed, cycles).has_threads_to_spare for cycles in (2, 3)] == [True, False]


def test_nobody_knows_how_often_a_service_is_asked_that_waits_itself() -> None:
    closed = unit(threads=9, reentrant=['g3'])
    waits = {'plan': (WAITS['watch'],)}
    callbacks = tuple(
        replace(each, blocking=waits.get(each.name, each.blocking))
        for each in closed.spec.callbacks
    )
    asked = replace(closed, spec=replace(closed.spec, callbacks=callbacks))
    alone = tuple(each for each in callbacks if each.name in ('plan', 'far'))
    unasked = replace(closed, spec=replace(closed.spec, callbacks=alone))
    assert [Slicer(each, 1).has_threads_to_spare for each in (asked, unasked)] == [False, True]


def test_what_is_asked_for_must_come_but_events_may_not() -> None:
    slicer = Slicer(unit(), max_cycle=1)
    assert slicer.only_asks(frozenset({'tick'}))
    assert not slicer.only_asks(frozenset({'watch'}))
    assert not slicer.only_asks(frozenset({'ask'}))  # ``watch`` may hold the group of its client
    alone = Slicer(unit('ask', 'client', 'plan'), max_cycle=1)
    assert alone.only_asks(frozenset({'ask'}))


def test_who_holds_a_group_while_waiting() -> None:
    slicer = Slicer(unit(), max_cycle=1)
    assert slicer.holders('busy') == slicer.holders('ask') == {'ask'}
    assert slicer.holders('far') == frozenset()
    assert slicer.waiting == {'ask', 'watch'}
    assert Slicer(unit(reentrant=['g1']), 1).holders('busy') == frozenset()


def test_a_slice_has_its_groups_and_as_many_threads_as_can_be_at_work() -> None:
    part = Slicer(unit(threads=6), 1).cut(frozenset({'ask', 'busy', 'client', 'plan'})).spec
    assert [each.name for each in part.callbacks] == ['ask', 'busy', 'client', 'plan']
    assert [group.name for group in part.groups] == ['g1', 'g2', 'g3']
    assert part.executor.threads == ('t0', 't1', 't2')


def test_members_of_a_reentrant_group_are_at_work_once_for_each_arrival() -> None:
    closed = unit(threads=9, reentrant=['g1'])
    threads = {
        cycles: len(Slicer(closed, cycles).cut(frozenset({'ask', 'busy'})).spec.executor.threads)
        for cycles in (1, 2)
    }
    assert threads == {1: 2, 2: 4}


def test_a_client_of_two_services_has_neither_in_a_slice() -> None:
    """Two bear the name, so that nobody knows who answers; in a slice there may be only one."""
    closed = unit()
    second = replace(callback('plan'), name='plan_too')
    closed = replace(closed, spec=replace(closed.spec, callbacks=(*closed.spec.callbacks, second)))
    part = Slicer(closed, 1).cut(frozenset({'ask', 'client', 'plan'})).spec
    assert {each.name: each.key for each in part.callbacks} == {
        'ask': None,
        'client': None,
        'plan': 'make_plan',
    }


def named(closed: ClosedSpec, *names: str) -> Spec:
    return Slicer(closed, 1).cut(frozenset(names)).spec


def shape_of(part: Spec) -> Shape:
    return outline_of(ClosedSpec(spec=part, assumptions=()), 1).shape


def test_names_are_no_part_of_a_shape() -> None:
    closed = unit()
    assert shape_of(named(closed, 'ask')) != shape_of(named(closed, 'tick'))
    assert shape_of(named(closed, 'busy')) == shape_of(named(closed, 'far'))
    assert shape_of(named(closed, 'busy', 'plan')) == shape_of(named(closed, 'busy', 'far'))


def with_types(part: Spec, *kinds: EntityKind) -> Spec:
    pairs = zip(part.callbacks, kinds, strict=True)
    served = tuple(replace(c, entity=kind, type=kind.published_type) for c, kind in pairs)
    return replace(part, callbacks=served)


def with_one_reentrant(part: Spec) -> Spec:
    first, *others = part.groups
    return replace(part, groups=(replace(first, type=GroupType.REENTRANT), *others))


SUBSCRIPTION, CLIENT = EntityKind.SUBSCRIPTION, EntityKind.CLIENT
GUARD, TASK, WAITABLE = EntityKind.GUARD_CONDITION, EntityKind.TASK, EntityKind.WAITABLE


def test_of_ranks_only_the_order_is_part_of_a_shape() -> None:
    pair = with_one_reentrant(named(unit(), 'busy', 'far'))
    in_order = shape_of(with_types(pair, EntityKind.TIMER, SUBSCRIPTION))
    assert shape_of(with_types(pair, SUBSCRIPTION, CLIENT)) == in_order
    assert shape_of(with_types(pair, SUBSCRIPTION, SUBSCRIPTION)) == in_order
    assert shape_of(with_types(pair, CLIENT, SUBSCRIPTION)) != in_order


def test_what_the_executors_treat_apart_is_part_of_a_shape() -> None:
    """Whether a guard condition is served before another entity, or after it, too."""
    pair = with_one_reentrant(named(unit(), 'busy', 'far'))
    kinds = [
        (one, other)
        for one in (GUARD, TASK, WAITABLE, SUBSCRIPTION)
        for other in (GUARD, TASK, WAITABLE, SUBSCRIPTION)
    ]
    assert len({shape_of(with_types(pair, *each)) for each in kinds}) == len(kinds)
    before = shape_of(with_types(pair, GUARD, CLIENT))
    assert before != shape_of(with_types(pair, GUARD, SUBSCRIPTION))
    assert before != shape_of(with_types(pair, CLIENT, GUARD))


def test_what_the_model_depends_on_is_part_of_a_shape() -> None:
    base = named(unit(), 'busy', 'far')
    one, other = base.callbacks
    others = {
        'one group': replace(base, callbacks=(one, replace(other, group=one.group))),
        'two nodes': replace(base, callbacks=(one, replace(other, node='other'))),
        'one thread': replace(base, executor=replace(base.executor, threads=('t0',))),
        'one waits': replace(base, callbacks=(replace(one, blocking=(WAITS['watch'],)), other)),
        'reentrant': with_one_reentrant(base),
        'another release': replace(base, rclpy='7.1.9'),
    }
    shapes = {name: shape_of(spec) for name, spec in others.items()}
    assert shape_of(base) not in shapes.values()
    assert len(set(shapes.values())) == len(others)


def test_a_shape_is_the_same_with_and_without_looking_at_the_slice() -> None:
    """What is known of callbacks that wait for nothing is put together without cutting."""
    slicer = Slicer(unit(), 1)
    for names in (('tick',), ('far', 'tick'), ('plan', 'far', 'tick')):
        outline = slicer.outline(frozenset(names))
        assert outline is not None
        assert outline.shape == shape_of(slicer.cut(frozenset(names)).spec)
