"""Whose callback each entity of a trace is, and how many a line of a loop has made."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import pytest

from ros2cc_extract.conform.entity_matching import match, with_copies
from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

EXECUTOR = 1
SUBSCRIPTION, TIMER, CLIENT = EntityKind.SUBSCRIPTION, EntityKind.TIMER, EntityKind.CLIENT
IN_LOOP = Unknown('made in a loop')


@dataclass(frozen=True)
class Known:
    """What a specification says of a callback."""

    kind: EntityKind
    function: str | None = None
    node: str | Unknown = 'arm'
    key: str | Unknown | None = None


def spec_of(*known: Known) -> Spec:
    return Spec(
        name='unit',
        callbacks=tuple(
            Callback(
                name=f'c{place}',
                type=each.kind.published_type,
                entity=each.kind,
                group='g',
                node=each.node,
                function=each.function,
                key=each.key,
            )
            for place, each in enumerate(known)
        ),
        groups=(CallbackGroup(name='g', type=GroupType.REENTRANT),),
        executor=Executor(name='executor', threads=('t0',)),
    )


def subject(
    number: int,
    kind: EntityKind,
    name: str,
    key: str | None = None,
    node: str | None = 'arm',
    executor: int | None = EXECUTOR,
    group: int = 9,
) -> Subject:
    return Subject(number, kind.value, node, group, executor, name, key)


def trace_of(*subjects: Subject, events: Iterable[tuple[int, int]] = ()) -> Trace:
    """Begins by clock and subject."""
    begins = tuple(Event(clock, 100, 'begin', number) for clock, number in events)
    return Trace(7, '9.1.2', 0, {}, {each.number: each for each in subjects}, begins)


@pytest.mark.parametrize(
    ('of_trace', 'of_spec', 'fits'),
    [
        (subject(2, TIMER, 'arm.Arm.tick'), Known(TIMER, 'Arm.tick'), True),
        (subject(2, TIMER, 'arm.Arm.tick'), Known(TIMER, 'Arm.tock'), False),
        (subject(2, TIMER, 'arm.Arm.tick'), Known(SUBSCRIPTION, 'Arm.tick'), False),
        (subject(2, TIMER, 'arm.Arm.tick'), Known(TIMER, 'Arm.tick', node='leg'), False),
        (subject(2, TIMER, 'tick', node=None), Known(TIMER, 'tick', node='leg'), True),
        (subject(2, TIMER, 'tick'), Known(TIMER, 'tick', node=Unknown('a parameter')), True),
        (subject(2, TIMER, 'tick', executor=5), Known(TIMER, 'tick'), False),
        (subject(2, SUBSCRIPTION, 'on', 'a'), Known(SUBSCRIPTION, 'on', key='a'), True),
        (subject(2, SUBSCRIPTION, 'on', 'a'), Known(SUBSCRIPTION, 'on', key='b'), False),
        (subject(2, SUBSCRIPTION, 'on', 'a'), Known(SUBSCRIPTION, 'on', key=Unknown('?')), True),
        (subject(2, CLIENT, 'plan', 'plan'), Known(CLIENT, key='plan'), True),
        (subject(2, CLIENT, 'plan', 'plan'), Known(CLIENT, 'done', key='plan'), True),
        (subject(2, SUBSCRIPTION, 'other', 'a'), Known(SUBSCRIPTION, key='a'), True),
    ],
)
def test_a_subject_is_known_by_kind_node_name_and_key(
    of_trace: Subject, of_spec: Known, fits: bool
) -> None:
    assert match(trace_of(of_trace), EXECUTOR, spec_of(of_spec)) == ({2: 0} if fits else {})


def test_two_of_one_name_are_two_callbacks_and_a_third_is_none() -> None:
    subjects = [subject(number, TIMER, 'tick') for number in (2, 3, 4)]
    spec = spec_of(*[Known(TIMER, 'tick')] * 2)
    together = trace_of(*subjects, events=[(0, 2), (1, 3), (2, 4), (3, 2), (4, 3), (5, 4)])
    assert match(together, EXECUTOR, spec) == {2: 0, 3: 1}


def test_what_is_made_anew_is_the_same_callback() -> None:
    subjects = [subject(number, TIMER, 'tick') for number in (2, 3, 4)]
    one_by_one = trace_of(*subjects, events=[(0, 2), (1, 2), (2, 3), (3, 4)])
    spec = spec_of(Known(TIMER, 'tick'))
    assert match(one_by_one, EXECUTOR, spec) == {2: 0, 3: 0, 4: 0}
    in_another_group = trace_of(*subjects[:2], replace(subjects[2], group=8), events=[(0, 2)])
    assert match(in_another_group, EXECUTOR, spec) == {2: 0, 3: 0}


def test_tasks_of_one_function_are_one_callback() -> None:
    subjects = [subject(number, EntityKind.TASK, 'work') for number in (2, 3)]
    together = trace_of(*subjects, events=[(0, 2), (1, 3), (2, 2)])
    assert match(together, EXECUTOR, spec_of(Known(EntityKind.TASK, 'work'))) == {2: 0, 3: 0}


def legs(count: int | Unknown, groups: int | Unknown) -> Spec:
    """A line of a loop makes a timer that calls a client, which another line of it makes."""
    call = Blocking(call='client.call', on='foot', wakers=(Waker(by='foot'),))
    step, foot = spec_of(Known(TIMER, 'step'), Known(CLIENT, key='plan')).callbacks
    return replace(
        spec_of(),
        callbacks=(
            replace(step, name='step', count=count, blocking=(call,)),
            replace(foot, name='foot', count=count),
        ),
        groups=(CallbackGroup(name='g', type=GroupType.EXCLUSIVE, count=groups),),
    )


def walk(groups: tuple[int, int, int]) -> Trace:
    """Three legs, all at work at a time, in these groups."""
    subjects = [
        each
        for lap, group in enumerate(groups)
        for each in (
            subject(2 * lap + 2, TIMER, 'step', group=group),
            subject(2 * lap + 3, CLIENT, 'plan', 'plan', group=group),
        )
    ]
    numbers = [each.number for each in subjects] * 2
    return trace_of(*subjects, events=list(enumerate(numbers)))


def told(spec: Spec) -> list[tuple[str, str, str | None]]:
    """Name and group of each callback, and whom it waits for."""
    return [
        (c.name, c.group, str(c.blocking[0].on) if c.blocking else None) for c in spec.callbacks
    ]


def test_a_line_of_unknown_count_has_made_as_many_as_the_trace_shows() -> None:
    spec, several = with_copies(walk((8, 8, 8)), EXECUTOR, legs(IN_LOOP, 1))
    assert told(spec) == [
        ('step', 'g', 'foot'),
        ('foot', 'g', None),
        ('step_2', 'g', 'foot_2'),
        ('foot_2', 'g', None),
        ('step_3', 'g', 'foot_3'),
        ('foot_3', 'g', None),
    ]
    assert [waker.by for waker in spec.callbacks[2].blocking[0].wakers] == ['foot_2']
    assert (len(spec.groups), several) == (1, {'step', 'foot'})
    assert match(walk((8, 8, 8)), EXECUTOR, spec) == {2: 0, 3: 1, 4: 2, 5: 3, 6: 4, 7: 5}


def test_each_lap_of_a_loop_may_have_made_a_group() -> None:
    spec, _ = with_copies(walk((8, 9, 8)), EXECUTOR, legs(IN_LOOP, IN_LOOP))
    in_groups = ['g', 'g', 'g_2', 'g_2', 'g', 'g']
    assert [callback.group for callback in spec.callbacks] == in_groups
    assert [(group.name, group.count) for group in spec.groups] == [('g', IN_LOOP), ('g_2', 1)]


@pytest.mark.parametrize('count', [3, IN_LOOP])
def test_what_has_run_once_is_not_copied(count: int | Unknown) -> None:
    spec = legs(count, 1)
    trace = trace_of(subject(2, TIMER, 'step'), events=[(0, 2)])
    assert with_copies(trace, EXECUTOR, spec) == (spec, frozenset())


def test_a_known_count_is_not_exceeded() -> None:
    spec, _ = with_copies(walk((8, 8, 8)), EXECUTOR, legs(2, 1))
    assert [callback.name for callback in spec.callbacks] == ['step', 'foot', 'step_2', 'foot_2']
