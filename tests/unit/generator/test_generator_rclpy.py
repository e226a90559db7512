"""What profile rclpy says, against what the executors of rclpy 7.1.6 and 9.1.2 were seen to do."""

from dataclasses import replace
from itertools import pairwise

import pytest
from generator_units import closed_unit

from ros2cc_extract.checker.api import Fairness, Query, Verdict, check, read_model
from ros2cc_extract.generator.build import Family, Profile, RenderedModel, Text, render
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.model import EntityKind

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'


def model_of(unit: ClosedSpec, max_cycle: int | None = 1) -> RenderedModel:
    return render(unit, profile=Profile.RCLPY, max_cycle=max_cycle)


def holds(model: RenderedModel, formula: str, fairness: Fairness = Fairness.NONE) -> bool:
    read = read_model(model.xml, 'arm.xml')
    (answer,) = check(read, [Query(formula, '', None)], fairness=fairness).answers
    return answer.verdict is Verdict.SATISFIED


def starving(unit: ClosedSpec, max_cycle: int | None) -> list[str]:
    """The callbacks that starve although threads and callbacks are fair."""
    model = model_of(unit, max_cycle)
    return [
        query.callbacks[0]
        for query in model.queries
        if query.family is Family.STARVATION and not holds(model, query.formula, Fairness.WEAK)
    ]


def test_clients_are_served_before_services():
    model = model_of(closed_unit('add:SRV:g reply:CLT:g', 'g:REENTRANT', 1, SINGLE))
    assert holds(model, 'A[] not (cb_running(0) and executor.harvest[1])')
    assert holds(model, 'E<> (cb_running(1) and executor.harvest[0])')


def test_waitables_are_served_before_timers():
    unit = closed_unit('tick:TMR:g goal:SRV:g', 'g:REENTRANT', 1, SINGLE)
    tick, goal = unit.spec.callbacks
    goal = replace(goal, entity=EntityKind.ACTION_SERVER)
    unit = replace(unit, spec=replace(unit.spec, callbacks=(tick, goal)))
    assert holds(model_of(unit), 'A[] not (cb_running(0) and executor.harvest[1])')


def test_nodes_are_served_in_any_order():
    unit = closed_unit('a:TMR:g b:TMR:g', 'g:REENTRANT', 1, SINGLE)
    a, b = unit.spec.callbacks
    callbacks = (replace(a, node='a'), replace(b, node='b'))
    model = model_of(replace(unit, spec=replace(unit.spec, callbacks=callbacks)))
    assert holds(model, 'E<> (cb_running(0) and executor.harvest[1])')
    assert holds(model, 'E<> (cb_running(1) and executor.harvest[0])')


def test_two_members_of_an_exclusive_group_are_queued_at_once_and_one_is_refused():
    model = model_of(closed_unit('a:SUB:g b:SUB:g', 'g:EXCLUSIVE', 2, MULTI))
    assert holds(model, 'E<> (cb_queued[0] and cb_queued[1])')
    assert holds(model, 'E<> (thread_1.popped and cb_running(0) and thread_0.running)')
    assert holds(model, 'A[] not (cb_running(0) and cb_running(1))')


def test_polling_goes_on_while_all_threads_run():
    model = model_of(closed_unit('a:SUB:g b:SUB:g', 'g:REENTRANT', 1, MULTI))
    assert holds(model, 'E<> (cb_running(0) and cb_queued[1])')


def test_one_message_gives_one_execution():
    once = model_of(closed_unit('a:SUB:g', 'g:REENTRANT', 2, MULTI), max_cycle=1)
    twice = model_of(closed_unit('a:SUB:g', 'g:REENTRANT', 2, MULTI), max_cycle=2)
    assert holds(once, 'A[] cb_runs(0) <= 1')
    assert not holds(twice, 'A[] cb_runs(0) <= 1')


def test_the_events_executor_serves_in_the_order_of_arrival_without_groups():
    model = model_of(closed_unit('add:SRV:g tick:TMR:g', 'g:EXCLUSIVE', 1, EVENTS))
    assert holds(model, 'E<> (cb_running(0) and cb_waiting[1] > 0)')
    assert holds(model, 'E<> (cb_running(1) and cb_waiting[0] > 0)')
    assert holds(model, 'A[] not group_closed[0]')


@pytest.mark.parametrize('executor', [SINGLE, MULTI, EVENTS])
def test_an_executor_with_nothing_to_do_is_no_dead_lock(executor: str):
    model = model_of(closed_unit('a:SUB:g b:TMR:g', 'g:EXCLUSIVE', 2, executor))
    assert holds(model, 'E<> deadlock')
    assert holds(model, model.queries[0].formula)


@pytest.mark.parametrize('max_cycle', [1, 2])
def test_nobody_starves_while_arrivals_are_bounded(max_cycle: int):
    unit = closed_unit('a:TMR:g b:SUB:g c:SUB:g', 'g:EXCLUSIVE', 2, MULTI)
    assert starving(unit, max_cycle) == []


@pytest.mark.parametrize(
    ('callbacks', 'kind', 'executor', 'expected'),
    [
        ('a:SUB:g b:SUB:g', 'EXCLUSIVE', MULTI, ['b']),
        ('a:SUB:g b:SUB:g c:SUB:g', 'EXCLUSIVE', MULTI, ['a', 'b', 'c']),
        ('a:SUB:g b:SUB:g c:SUB:g', 'REENTRANT', MULTI, []),
        ('a:SUB:g b:SUB:g c:SUB:g', 'EXCLUSIVE', SINGLE, []),
        ('a:SUB:g b:SUB:g c:SUB:g', 'EXCLUSIVE', EVENTS, []),
    ],
)
def test_who_starves_under_unlimited_arrivals(
    callbacks: str, kind: str, executor: str, expected: list[str]
):
    unit = closed_unit(callbacks, f'g:{kind}', 2, executor)
    assert starving(unit, None) == expected


def test_the_compact_text_knows_that_two_rivals_starve_the_member_served_first():
    unit = closed_unit('a:SUB:g b:SUB:g c:SUB:g d:SUB:g', 'g:EXCLUSIVE', 2, MULTI)
    model = render(unit, profile=Profile.RCLPY, text=Text.COMPACT, max_cycle=None)
    first = next(query for query in model.queries if query.family is Family.STARVATION)
    assert not holds(model, first.formula, Fairness.WEAK)


def test_a_class_of_the_users_own_counts_by_its_threads():
    alone = model_of(closed_unit('a:SUB:g', 'g:EXCLUSIVE', 1, 'MyExecutor'))
    many = model_of(closed_unit('a:SUB:g', 'g:EXCLUSIVE', 2, 'MyExecutor'))
    assert 'profile rclpy, SingleThreadedExecutor' in alone.xml
    assert 'profile rclpy, MultiThreadedExecutor' in many.xml


KINDS = ('waitable', 'timer', 'subscription', 'guard_condition', 'client', 'service')


@pytest.mark.parametrize(('first', 'second'), list(pairwise(KINDS)))
def test_kinds_are_served_in_their_order_however_they_were_made(first: str, second: str):
    """Both are found by one wait: the later one does not run while the first is left."""
    unit = closed_unit('late:SUB:g early:SUB:g', 'g:REENTRANT', 1, SINGLE)
    kinds = {'early': EntityKind(first), 'late': EntityKind(second)}
    callbacks = tuple(
        replace(c, entity=kinds[c.name], type=kinds[c.name].published_type)
        for c in unit.spec.callbacks
    )
    model = model_of(replace(unit, spec=replace(unit.spec, callbacks=callbacks)))
    assert holds(model, 'A[] not (cb_running(0) and executor.harvest[1])')
    assert holds(model, 'E<> (cb_running(1) and executor.harvest[0])')


def test_one_kind_is_served_in_the_order_of_creation():
    model = model_of(closed_unit('a:SUB:g b:SUB:g', 'g:REENTRANT', 1, SINGLE))
    assert holds(model, 'A[] not (cb_running(1) and executor.harvest[0])')
    assert holds(model, 'E<> (cb_running(0) and executor.harvest[1])')


def test_a_queued_entity_is_not_collected_again_and_a_running_one_is():
    model = model_of(closed_unit('a:SUB:g', 'g:REENTRANT', 2, MULTI), max_cycle=2)
    assert holds(model, 'A[] not (cb_queued[0] > 0 and executor.harvest[0])')
    assert holds(model, 'E<> (cb_queued[0] > 0 and cb_running(0))')


def test_members_of_a_closed_group_are_not_waited_for():
    """No lap ever begins with one: what is found was found while the group was open."""
    model = model_of(closed_unit('a:SUB:g', 'g:EXCLUSIVE', 2, MULTI), max_cycle=2)
    assert holds(model, 'A[] not (group_closed[0] and executor.harvest[0])')


@pytest.mark.parametrize('executor', [SINGLE, MULTI, EVENTS])
def test_data_is_taken_by_whoever_begins_and_else_stays(executor: str):
    """A refused start takes nothing; being stuck with data left would be a deadlock."""
    model = model_of(closed_unit('a:SUB:g b:SUB:g', 'g:EXCLUSIVE', 2, executor))
    assert holds(model, 'E<> (cb_running(0) and cb_waiting[0] == 0)')
    for name in (0, 1):
        assert holds(model, f'cb_waiting[{name}] > 0 --> cb_running({name})', Fairness.WEAK)


@pytest.mark.parametrize('executor', [SINGLE, MULTI, EVENTS])
def test_a_timer_that_has_missed_periods_is_due_once(executor: str):
    unit = closed_unit('tick:TMR:g data:SUB:g', 'g:EXCLUSIVE', 1, executor)
    model = model_of(unit, max_cycle=3)
    assert holds(model, 'A[] cb_waiting[0] <= 1')
    assert holds(model, 'E<> cb_waiting[1] == 3')


def test_the_spinning_thread_runs_callbacks_one_after_the_other():
    model = model_of(closed_unit('a:SUB:g b:SUB:h', 'g:REENTRANT h:REENTRANT', 3, SINGLE))
    assert holds(model, 'A[] not (cb_running(0) and cb_running(1))')
    assert 'NUM_THREAD = 1;' in model.xml
