"""
Nested spins, absent services and foreign futures, as they were seen on rclpy 7.1.6 and 9.1.2.

``ask`` spins for the answer that ``reply`` takes, or otherwise waits for what no callback gives.
"""

from __future__ import annotations

from dataclasses import replace

import pytest
from generator_units import closed_unit

from ros2cc_extract.checker.api import Query, Verdict, check, read_model
from ros2cc_extract.generator.build import Profile, RenderedModel, render
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.effects import Act, Blocking

SINGLE, MULTI, EVENTS = 'SingleThreadedExecutor', 'MultiThreadedExecutor', 'EventsExecutor'
TWO_GROUPS = 'g:EXCLUSIVE h:EXCLUSIVE'
HERE = Place('arm.py', 7)
#: The callbacks of most units by place.
ASK, REPLY, TICK = range(3)


def spinning(
    *blocks: Blocking,
    executor: str = SINGLE,
    threads: int = 1,
    spun: str = 'spin',
    rclpy: str = '7.1.6',
    reply: str = 'h',
) -> ClosedSpec:
    """Build a unit whose ``ask`` does that; ``tick`` is in another group, on the same node."""
    unit = closed_unit(f'ask:TMR:g reply:CLT:{reply} tick:TMR:h', TWO_GROUPS, threads, executor)
    ask, *others = (replace(callback, node='arm') for callback in unit.spec.callbacks)
    ask = replace(ask, blocking=tuple(replace(block, source=HERE) for block in blocks))
    executor_of = replace(unit.spec.executor, spun=spun)
    return replace(
        unit,
        spec=replace(unit.spec, callbacks=(ask, *others), executor=executor_of, rclpy=rclpy),
    )


def until(how: str = 'executor', on: str = 'executor', seconds: float | None = None):
    """Spin for the answer of ``reply``."""
    return (
        Blocking(call=f'{how}.spin_until_future_complete', on=on),
        Blocking(call='spin for future', on='reply', seconds=seconds),
    )


def model_of(unit: ClosedSpec) -> RenderedModel:
    return render(unit, profile=Profile.RCLPY)


def can_be(unit: ClosedSpec, formula: str) -> bool:
    return decided(unit, f'E<> ({formula})') is Verdict.SATISFIED


def decided(unit: ClosedSpec, formula: str) -> Verdict:
    model = read_model(model_of(unit).xml, 'arm.xml')
    return check(model, [Query(formula, None, None)]).answers[0].verdict


def hangs(unit: ClosedSpec) -> bool:
    return can_be(unit, f'deadlock and cb_unfinished({ASK})')


@pytest.mark.parametrize(
    ('executor', 'threads', 'reply', 'expected'),
    [
        (SINGLE, 1, 'h', False),
        (SINGLE, 1, 'g', True),
        (MULTI, 2, 'h', False),
        (MULTI, 2, 'g', True),
        (MULTI, 1, 'h', True),
    ],
)
def test_the_own_executor_spun_without_a_time_out(executor, threads, reply, expected):
    """On a pool the worker that spins only hands over: another one has to run the client."""
    assert hangs(spinning(*until(), executor=executor, threads=threads, reply=reply)) == expected


def test_a_time_out_ends_a_spin_for_an_answer_that_cannot_come():
    unit = spinning(*until(seconds=0.5), reply='g')
    assert not hangs(unit)
    assert not can_be(unit, 'thread_0.answered')


def test_others_run_inside_on_the_same_thread_and_members_of_the_group_do_not():
    unit = spinning(*until())
    assert can_be(unit, f'cb_running({ASK}) and cb_running({TICK}) and thread_nested[0] == 1')
    assert not can_be(spinning(*until(), reply='g'), f'cb_running({ASK}) and cb_running({REPLY})')


def test_what_the_lap_had_found_is_taken_inside_and_not_run_again():
    assert not can_be(spinning(*until()), f'cb_runs({TICK}) > 1 or cb_runs({REPLY}) > 1')
    assert decided(spinning(*until()), 'A[] (deadlock imply cb_all_served())') is Verdict.SATISFIED


def test_the_rest_of_the_lap_before_is_dropped():
    """Other arguments begin another generator (``wait_for_ready_callbacks``)."""
    just_ended = f'executor.serving and cb_ended[{ASK}] and executor.served_cb_id == {ASK}'
    has_spun = f'cb_sent[{REPLY}] + cb_waiting[{REPLY}] > 0'
    goes_on = (
        f'{just_ended} and {has_spun} and executor.serving_node == 0 and executor.harvest[{TICK}]'
    )
    assert not can_be(spinning(*until(seconds=0.5)), goes_on)
    assert can_be(spinning(*until('rclpy', 'arm', seconds=0.5)), goes_on)


@pytest.mark.parametrize(('executor', 'threads'), [(SINGLE, 1), (MULTI, 4)])
def test_the_global_executor_serves_the_node_meanwhile_and_nobody_does_afterwards(
    executor: str, threads: int
):
    unit = spinning(*until('rclpy', 'arm'), executor=executor, threads=threads)
    assert can_be(unit, f'node_taken[0] and cb_running({ASK}) and cb_running({TICK})')
    assert not hangs(unit)
    assert can_be(unit, f'deadlock and cb_waiting[{TICK}] == 1 and !node_spun[0]')


def test_who_spins_on_one_of_several_threads_runs_once():
    """For any number of threads, and any callbacks inside."""
    unit = spinning(*until('rclpy', 'arm'), executor=MULTI, threads=3)
    assert can_be(unit, f'cb_running({ASK}) and cb_running({TICK})')
    assert decided(unit, f'A[] cb_runs({ASK}) <= 1') is Verdict.SATISFIED


def test_under_plain_rclpy_spin_it_is_the_same_executor_and_the_node_stays():
    unit = spinning(*until('rclpy', 'arm'), spun='rclpy.spin')
    assert 'node_taken' not in model_of(unit).xml
    assert not hangs(unit)
    assert decided(unit, 'A[] (deadlock imply cb_all_served())') is Verdict.SATISFIED


def named(unit: ClosedSpec, kind: str) -> ClosedSpec:
    """Have ``ask`` name the executor that it spins, of that kind."""
    ask, *others = unit.spec.callbacks
    ask = replace(ask, changes=(Act(name=f'{kind}.add_node', source=HERE),))
    return replace(unit, spec=replace(unit.spec, callbacks=(ask, *others)))


def test_another_executor_takes_the_node_under_plain_rclpy_spin_too():
    unit = named(spinning(*until('rclpy', 'arm'), spun='rclpy.spin'), SINGLE)
    assert can_be(unit, f'node_taken[0] and cb_running({ASK}) and cb_running({TICK})')
    assert can_be(unit, f'deadlock and cb_waiting[{TICK}] == 1 and !node_spun[0]')


def test_an_executor_of_more_nodes_or_threads_that_takes_the_node_is_left_out():
    unit = named(spinning(*until('rclpy', 'arm')), 'executor')
    left_out = {query.family.value for query in model_of(unit).queries if query.left_out}
    assert {'deadlock', 'progress'} <= left_out


def test_another_node_of_the_unit_stays_where_it_is():
    unit = spinning(*until('rclpy', 'arm'))
    ask, reply, tick = unit.spec.callbacks
    callbacks = (ask, reply, replace(tick, node='base'))
    unit = replace(unit, spec=replace(unit.spec, callbacks=callbacks))
    assert not can_be(unit, f'cb_running({ASK}) and cb_running({TICK})')
    assert not can_be(unit, f'deadlock and cb_waiting[{TICK}] > 0')


@pytest.mark.parametrize('seconds', [None, 0.1])
def test_spin_once_ends_after_one_callback_or_its_time_out(seconds: float | None):
    """With nobody else to serve, it waits for what never comes."""
    unit = spinning(Blocking(call='executor.spin_once', on='executor', seconds=seconds))
    ask, *_ = unit.spec.callbacks
    alone = replace(unit, spec=replace(unit.spec, callbacks=(ask,)))
    assert hangs(alone) == (seconds is None)
    assert can_be(unit, f'cb_running({TICK}) and cb_running({ASK})')
    assert can_be(unit, f'thread_0.running and thread_0.waits_done == 1 and cb_ended[{TICK}]')


def test_a_loop_of_spins_ends_with_what_it_waits_for():
    loop = Blocking(call='busy wait', on='reply')
    step = Blocking(call='rclpy.spin_once', on='arm', seconds=0.1)
    assert not hangs(spinning(loop, step, spun='rclpy.spin'))
    assert hangs(spinning(loop, step, spun='rclpy.spin', reply='g'))


def test_a_loop_of_spins_on_plain_data_has_no_known_end():
    loop = Blocking(call='busy wait', on=Unknown('what ends the loop: not self.arrived'))
    step = Blocking(call='rclpy.spin_once', on='arm', seconds=0.1)
    unit = spinning(loop, step, spun='rclpy.spin')
    left_out = {query.family.value for query in model_of(unit).queries if query.left_out}
    assert left_out == {'deadlock', 'starvation', 'progress', 'pool_exhaustion'}


def test_spin_never_returns_but_serves_others():
    unit = spinning(Blocking(call='rclpy.spin', on='arm'), spun='rclpy.spin')
    assert hangs(unit)
    assert can_be(unit, f'deadlock and cb_running({ASK}) and cb_ended[{TICK}]')


def test_from_7_1_9_on_an_executor_that_spins_refuses_and_stops():
    unit = spinning(*until(), rclpy='7.1.9')
    assert not can_be(unit, f'cb_running({ASK}) and cb_running({TICK})')
    assert can_be(unit, f'executor.failed and deadlock and cb_waiting[{TICK}] == 1')
    assert not can_be(unit, f'spin_raised and cb_running({TICK})')


@pytest.mark.parametrize(('seconds', 'expected'), [(None, True), (0.1, False)])
def test_two_threads_that_ask_a_pool_for_the_same_resume_one_generator(seconds, expected):
    """Measured: ``ValueError: generator already executing``, and the spin ends at a dispatch."""
    block = Blocking(call='executor.spin_once', on='executor', seconds=seconds)
    unit = spinning(block, executor=MULTI, threads=4)
    assert ('spin_raised' in model_of(unit).xml) == expected
    if expected:
        assert can_be(unit, 'executor.failed')


def test_who_ends_a_spin_for_an_unknown_future_is_not_known():
    """But what runs inside is."""
    spin = Blocking(call='executor.spin_until_future_complete', on='executor')
    left_out = {query.family.value for query in model_of(spinning(spin)).queries if query.left_out}
    assert left_out == {'deadlock', 'starvation', 'progress', 'pool_exhaustion'}


@pytest.mark.parametrize(
    'block',
    [
        Blocking(call='executor.spin_once', on='another'),
        Blocking(call='rclpy.spin_once', on='another_node'),
        Blocking(call='executor.spin_once_until_future_complete', on='executor'),
        Blocking(call='spin for future', on='reply'),
    ],
)
def test_a_spin_of_somebody_else_is_left_out_and_so_is_what_runs_inside(block: Blocking):
    families = {
        query.family.value for query in model_of(spinning(block)).queries if query.left_out
    }
    assert {'progress', 'can_overlap', 'never_together', 'serial'} <= families


def test_under_the_events_executor_nested_spins_are_left_out():
    model = model_of(spinning(*until(), executor=EVENTS))
    assert 'start_spin' not in model.xml
    assert any(query.left_out for query in model.queries)


FOREIGN = Blocking(call='await', on='future', foreign=True)


@pytest.mark.parametrize(('executor', 'threads'), [(SINGLE, 1), (MULTI, 2)])
def test_a_future_done_by_another_thread_is_seen_when_something_else_wakes_the_executor(
    executor: str, threads: int
):
    unit = spinning(FOREIGN, executor=executor, threads=threads)
    alone = replace(unit, spec=replace(unit.spec, callbacks=unit.spec.callbacks[:1]))
    assert can_be(alone, 'deadlock and cb_foreign_done[0][0]')
    assert can_be(unit, f'executor.serving and cb_foreign_done[0][0] and cb_ended[{TICK}]')


@pytest.mark.parametrize(
    ('rclpy', 'wakes'),
    [
        *((release, False) for release in ('3.3.20', '4.1.7', '7.1.8', '9.1.3', '10.0.2')),
        *((release, True) for release in ('3.3.21', '7.1.9', '9.1.4', '10.0.3', '11.0.0')),
    ],
)
@pytest.mark.parametrize(('executor', 'threads'), [(SINGLE, 1), (MULTI, 2)])
def test_a_release_may_wake_the_executor_for_it(
    rclpy: str, wakes: bool, executor: str, threads: int
):
    """Seen on 3.3.21, 7.1.9 and 9.1.5: the coroutine goes on when the thread has set it."""
    unit = spinning(FOREIGN, executor=executor, threads=threads, rclpy=rclpy)
    alone = replace(unit, spec=replace(unit.spec, callbacks=unit.spec.callbacks[:1]))
    assert can_be(alone, 'deadlock and cb_unfinished(0)') is not wakes
    assert not any(query.left_out for query in model_of(alone).queries)


def test_a_wait_for_an_absent_service_holds_the_thread():
    wait = Blocking(call='wait_for_service', on='reply')
    assert can_be(spinning(wait), f'deadlock and thread_0.blocked and cb_waiting[{TICK}] == 1')
    many = spinning(wait, executor=MULTI, threads=2)
    assert not can_be(many, f'deadlock and cb_waiting[{TICK}] == 1')


def test_a_service_that_is_asked_is_there():
    """Its answers come from outside, so a wait for it ends as well; but when, nobody knows."""
    wait = Blocking(call='wait_for_service', on='reply')
    call = Blocking(call='client.call', on='reply')
    unit = spinning(wait, call, executor=MULTI, threads=2)
    assert not hangs(unit)
    assert any(query.left_out for query in model_of(unit).queries)
