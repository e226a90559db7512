"""
Deadlocks by waiting inside a callback, as they were seen on rclpy 7.1.6 and 9.1.2.

``ask`` calls the service ``plan`` synchronously by the client ``reply``.
"""

from dataclasses import replace

import pytest
from generator_units import closed_unit

from ros2cc_extract.checker.api import Limits, Query, Verdict, check, read_model
from ros2cc_extract.generator.build import Family, Profile, render
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import EntityKind

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'


def stuck(unit: ClosedSpec) -> list[str]:
    """The callbacks that may never end; none where the model has no deadlock."""
    model = render(unit, profile=Profile.RCLPY)
    read = read_model(model.xml, 'arm.xml')
    queries = [q for q in model.queries if q.family in (Family.PROGRESS, Family.DEADLOCK)]
    answers = check(read, [Query(q.formula, '', None) for q in queries]).answers
    bad = [q for q, a in zip(queries, answers, strict=True) if a.verdict is not Verdict.SATISFIED]
    assert bool(bad) == (Family.DEADLOCK in {query.family for query in bad})
    return [query.callbacks[0] for query in bad if query.family is Family.PROGRESS]


@pytest.mark.parametrize(
    ('groups', 'ask', 'reply', 'threads', 'executor', 'is_stuck'),
    [
        pytest.param('g:EXCLUSIVE', 'g', 'g', 1, SINGLE, True, id='same exclusive, single'),
        pytest.param('g:EXCLUSIVE', 'g', 'g', 4, MULTI, True, id='same exclusive, multi'),
        pytest.param('g:EXCLUSIVE h:EXCLUSIVE', 'g', 'h', 1, SINGLE, True, id='other, single'),
        pytest.param('g:EXCLUSIVE h:EXCLUSIVE', 'g', 'h', 2, MULTI, False, id='other, multi'),
        pytest.param('g:EXCLUSIVE h:EXCLUSIVE', 'g', 'h', 1, MULTI, True, id='other, one worker'),
        pytest.param('g:REENTRANT', 'g', 'g', 1, SINGLE, True, id='reentrant, single'),
        pytest.param('g:REENTRANT', 'g', 'g', 2, MULTI, False, id='reentrant, multi'),
    ],
)
def test_a_synchronous_call(
    groups: str, ask: str, reply: str, threads: int, executor: str, is_stuck: bool
):
    callbacks = f'ask:TMR:{ask} reply:CLT:{reply}'
    unit = closed_unit(callbacks, groups, threads, executor, waits='ask:reply')
    assert stuck(unit) == (['ask'] if is_stuck else [])


@pytest.mark.parametrize(('group', 'is_stuck'), [('g', True), ('h', True), ('i', False)])
def test_a_call_to_a_service_of_the_same_node(group: str, is_stuck: bool):
    """The service must be outside the caller's group, and the reply needs no other worker."""
    callbacks = f'ask:TMR:g reply:CLT:h plan:SRV:{group}'
    threads = 1 if group == 'h' else 2
    unit = closed_unit(
        callbacks, 'g:EXCLUSIVE h:EXCLUSIVE i:EXCLUSIVE', threads, MULTI, 'ask:reply'
    )
    assert stuck(unit) == (['ask'] if is_stuck else [])


@pytest.mark.parametrize(('threads', 'expected'), [(2, ['a1', 'a2']), (3, [])])
def test_as_many_waiting_callbacks_as_workers_exhaust_the_pool(threads: int, expected: list[str]):
    callbacks = 'a1:TMR:g a2:TMR:g r1:CLT:g r2:CLT:g'
    unit = closed_unit(callbacks, 'g:REENTRANT', threads, MULTI, 'a1:r1 a2:r2')
    assert stuck(unit) == expected


@pytest.mark.parametrize(
    ('groups', 'threads', 'executor', 'is_stuck'),
    [('g h', 1, SINGLE, True), ('g h', 2, MULTI, False), ('g g', 2, MULTI, True)],
)
def test_an_event_that_another_callback_sets(
    groups: str, threads: int, executor: str, is_stuck: bool
):
    one, other = groups.split()
    unit = closed_unit(
        f'wait:SUB:{one} set:SUB:{other}',
        'g:EXCLUSIVE h:EXCLUSIVE',
        threads,
        executor,
        waits='wait:set',
    )
    assert stuck(unit) == (['wait'] if is_stuck else [])


@pytest.mark.parametrize(('client', 'is_stuck'), [('g', True), ('h', False)])
def test_an_event_that_a_done_callback_sets_needs_the_client(client: str, is_stuck: bool):
    callbacks = f'ask:TMR:g reply:CLT:{client} done:CLT:free'
    groups = 'g:EXCLUSIVE h:EXCLUSIVE free:REENTRANT'
    unit = closed_unit(callbacks, groups, 2, MULTI, waits='ask:done:Event.wait')
    ask, reply, done = unit.spec.callbacks
    done = replace(done, entity=EntityKind.DONE_CALLBACK, groupless=True)
    unit = replace(unit, spec=replace(unit.spec, callbacks=(ask, reply, done)))
    assert stuck(unit) == (['ask'] if is_stuck else [])


def test_a_wait_with_a_time_out_ends_by_itself():
    unit = closed_unit('ask:TMR:g reply:CLT:g', 'g:EXCLUSIVE', 2, MULTI)
    ask, reply = unit.spec.callbacks
    ask = replace(ask, blocking=(Blocking(call='client.call', on='reply', seconds=1.0),))
    unit = replace(unit, spec=replace(unit.spec, callbacks=(ask, reply)))
    assert stuck(unit) == []


@pytest.mark.parametrize('call', ['wait_for_service', 'wait_for_server'])
@pytest.mark.parametrize('service', ['plan', 'home'])
def test_a_service_may_be_absent_that_nobody_of_the_unit_offers(call: str, service: str):
    unit = closed_unit('ask:TMR:g reply:CLT:g serve:SRV:g', 'g:EXCLUSIVE', 1, SINGLE)
    ask, reply, serve = unit.spec.callbacks
    ask = replace(ask, blocking=(Blocking(call=call, on='reply'),))
    reply = replace(reply, entity=EntityKind.CLIENT, key='plan')
    serve = replace(serve, entity=EntityKind.SERVICE, key=service)
    unit = replace(unit, spec=replace(unit.spec, callbacks=(ask, reply, serve)))
    assert stuck(unit) == ([] if service == 'plan' else ['ask'])


def test_an_answer_is_for_the_callback_that_asked():
    """Two callbacks share a client: one answer lets one of them go on."""
    unit = closed_unit('a:TMR:g b:TMR:g r:CLT:g', 'g:REENTRANT', 3, MULTI, 'a:r b:r')
    assert stuck(unit) == []


@pytest.mark.parametrize(
    ('reply', 'threads', 'executor', 'is_stuck'),
    [
        pytest.param('g', 1, SINGLE, True, id='same exclusive, single'),
        pytest.param('g', 4, MULTI, True, id='same exclusive, multi'),
        pytest.param('g', 1, EVENTS, False, id='same exclusive, events'),
        pytest.param('h', 1, SINGLE, False, id='other, single'),
        pytest.param('h', 1, MULTI, False, id='other, one worker'),
    ],
)
def test_an_awaited_call(reply: str, threads: int, executor: str, is_stuck: bool):
    unit = closed_unit(
        f'ask:SUB:g reply:CLT:{reply}',
        'g:EXCLUSIVE h:EXCLUSIVE',
        threads,
        executor,
        waits='ask:reply:await',
    )
    assert stuck(unit) == (['ask'] if is_stuck else [])


@pytest.mark.parametrize('rclpy', [None, '7.1.6', '9.1.2'])
@pytest.mark.parametrize('executor', [SINGLE, MULTI])
def test_coroutines_outside_every_group_go_on(executor: str, rclpy: str | None):
    """Measured on rclpy 7.1.6: an execute callback that awaits a client ended, 5 goals of 5."""
    callbacks = 'execute:SUB:none other:SUB:none reply:CLT:g tick:TMR:g'
    awaited = 'execute:reply:await other:reply:await'
    unit = closed_unit(callbacks, 'none:REENTRANT g:EXCLUSIVE', 1, executor, awaited)
    tasks = [replace(c, entity=EntityKind.TASK, groupless=True) for c in unit.spec.callbacks[:2]]
    spec = replace(unit.spec, callbacks=(*tasks, *unit.spec.callbacks[2:]), rclpy=rclpy)
    unit = replace(unit, spec=spec)
    assert stuck(unit) == []
    read = read_model(render(unit, profile=Profile.RCLPY, max_cycle=2).xml, 'arm.xml')
    both_at_once = 'E<> (cb_suspended[0] > 0 and cb_waiting[0] > 0 and cb_answers[2] > 0)'
    all_end = 'A[] (deadlock imply cb_all_served())'
    answers = check(read, [Query(text, '', None) for text in (both_at_once, all_end)]).answers
    assert [answer.verdict for answer in answers] == [Verdict.SATISFIED] * 2


def test_an_event_of_a_timer_that_the_awaiting_callback_keeps_out():
    unit = closed_unit('ask:SRV:g tick:TMR:g', 'g:EXCLUSIVE', 4, MULTI, 'ask:tick:await')
    assert stuck(unit) == ['ask']


@pytest.mark.parametrize('executor', [SINGLE, MULTI])
def test_an_await_keeps_the_group_and_frees_the_thread(executor: str):
    callbacks = 'ask:SUB:g sibling:SUB:g other:SUB:h reply:CLT:h'
    unit = closed_unit(callbacks, 'g:EXCLUSIVE h:EXCLUSIVE', 1, executor, 'ask:reply:await')
    xml = render(unit, profile=Profile.RCLPY).xml
    read = read_model(xml, 'arm.xml')
    formulas = (
        'E<> cb_suspended[0]',
        'A[] not (cb_suspended[0] and cb_running(1))',
        'E<> (cb_suspended[0] and cb_running(2))',
        'A[] cb_suspended[0] imply group_closed[0]',
    )
    answers = check(read, [Query(formula, '', None) for formula in formulas]).answers
    assert [answer.verdict for answer in answers] == [Verdict.SATISFIED] * len(formulas)


def test_a_coroutine_may_go_on_on_another_thread():
    callbacks = 'ask:SUB:g other:SUB:h reply:CLT:h'
    unit = closed_unit(callbacks, 'g:EXCLUSIVE h:REENTRANT', 2, MULTI, 'ask:reply:await')
    read = read_model(render(unit, profile=Profile.RCLPY).xml, 'arm.xml')
    on_other = 'thread_1.waits_done == 1 and thread_1.running and thread_cb_assign_table[1] == 0'
    began_first = 'E<> (cb_suspended[0] and thread_0.running and !thread_running[1])'
    answers = check(read, [Query(f'E<> ({on_other})', '', None), Query(began_first, '', None)])
    assert [answer.verdict for answer in answers.answers] == [Verdict.SATISFIED] * 2


def test_the_events_executor_starts_a_callback_again_while_it_is_suspended():
    unit = closed_unit('ask:SUB:g reply:CLT:g', 'g:EXCLUSIVE', 1, EVENTS, 'ask:reply:await')
    model = render(unit, profile=Profile.RCLPY, max_cycle=2)
    read = read_model(model.xml, 'arm.xml')
    again = Query('E<> (cb_suspended[0] and cb_running(0))', '', None)
    (answer,) = check(read, [again]).answers
    assert answer.verdict is Verdict.SATISFIED


@pytest.mark.parametrize('max_cycle', [3, None])
def test_requests_of_callbacks_that_call_each_other_do_not_overflow(max_cycle: int | None):
    unit = closed_unit('plan:SRV:g ask:TMR:g reply:CLT:g', 'g:REENTRANT', 2, MULTI, 'plan:reply')
    read = read_model(render(unit, profile=Profile.RCLPY, max_cycle=max_cycle).xml, 'arm.xml')
    assert check(read, read.queries, limits=Limits(states=100_000)).states > 1_000
