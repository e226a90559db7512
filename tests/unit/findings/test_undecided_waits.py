"""CC120 and CC121: a wait that no model decides is reported once, and weighs with ``--strict``."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from finding_units import (
    ONE_THREAD,
    at,
    calls,
    client,
    found,
    only,
    subscription,
    threads,
    timer,
    unit,
)

from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.source_locations import Place, Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import ANSWER_LOOP, OUTSIDE, TIME, Act, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, Spec
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit


def test_a_wait_whose_end_nobody_knows_is_told() -> None:
    waits = calls('jobs', call='Barrier.wait')
    finding = only(unit(threads(2), timer('feed', blocking=waits)), 'CC120')
    assert finding.message == (
        'not decided: feed waits in Barrier.wait for jobs, and it is not known what ends it'
    )


def test_why_it_is_not_known_is_said() -> None:
    (wait,) = calls(None, call='Queue.get')
    wait = replace(wait, resource='jobs', escapes=Unknown('jobs is passed to plant.connect'))
    finding = only(unit(threads(2), timer('feed', blocking=(wait,))), 'CC120')
    assert finding.message.endswith(
        'for jobs, and it is not known what ends it: jobs is passed to plant.connect'
    )


def test_one_line_for_one_wait_however_many_callbacks_get_there() -> None:
    waits = calls('jobs', call='Barrier.wait')
    spec = unit(ONE_THREAD, timer('feed', blocking=waits), timer('drain', blocking=waits))
    assert found(spec) == ['CC120:40 note']
    assert only(spec, 'CC120').subjects == ('feed', 'drain')


def test_two_timers_of_one_function_are_one_for_the_reader() -> None:
    waits = calls('jobs', call='Barrier.wait')
    names = ('feed_1', 'feed_2')
    timers = [
        timer(name, function='arm.Arm.feed', defined=at(20), blocking=waits) for name in names
    ]
    finding = only(unit(threads(2), *timers), 'CC120')
    assert finding.message.startswith('not decided: Arm.feed waits in Barrier.wait')
    assert finding.subjects == names


def test_a_wait_that_is_found_to_hang_is_told_by_its_own_rule_alone() -> None:
    waits = calls('plan_client')
    assert found(unit(ONE_THREAD, timer('drive', blocking=waits), client('plan_client'))) == [
        'CC102:40'
    ]


def test_what_another_program_ends_rests_on_that_program() -> None:
    (wait,) = calls(None, call='subprocess.run')
    wait = replace(wait, wakers=(Waker(by=OUTSIDE),))
    spec = unit(threads(2), timer('feed', blocking=(wait,)))
    assert found(spec) == ['CC121:40 note']
    assert only(spec, 'CC121').message == (
        'feed waits in subprocess.run without a time-out, and waits forever unless '
        'something outside its executor ends it'
    )


def test_an_answer_that_somebody_else_may_give_too_is_told_once() -> None:
    (wait,) = calls(None, call='polling loop')
    wait = replace(wait, answer_to='plan', escapes=Unknown('no known code calls on_plan'))
    spec = unit(threads(2), timer('feed', blocking=(wait,)))
    assert found(spec) == ['CC120:40 note']


def test_what_nobody_here_sends_meanwhile_rests_on_other_programs() -> None:
    (wait,) = calls(None, call='Event.wait')
    wait = replace(wait, wakers=(Waker(by='listen', after=0),), unsent='go')
    sender = replace(timer('tell'), publishes=(Act(name='/go'),))
    spec = unit(
        threads(2), timer('feed', blocking=(wait,)), subscription('listen', 'other'), sender
    )
    assert found(spec) == ['CC121:40 note']
    assert only(spec, 'CC121').message == (
        'feed waits in Event.wait without a time-out, and waits forever unless another '
        'program publishes go, as tell cannot do so meanwhile'
    )


def test_the_main_program_may_wait_until_somebody_wants_it_to_end() -> None:
    wait = Blocking(call='Event.wait', source=at(70), resource='done', wakers=(Waker(by=OUTSIDE),))
    spec = unit(threads(2), timer('feed'))
    main = Activity(name='main', kind=ActivityKind.MAIN, blocking=(wait,))
    assert found(replace(spec, activities=(main,))) == []
    held = replace(main, blocking=(replace(wait, held=('lock',)),))
    assert found(replace(spec, activities=(held,))) == ['CC121:70 note']
    needing = replace(wait, source=at(80), resource='go', wakers=(Waker(by='main', after=1),))
    needed = unit(threads(2), timer('feed', blocking=(needing,)))
    assert 'CC121:70 note' in found(replace(needed, activities=(main,)))
    thread = replace(main, kind=ActivityKind.THREAD)
    assert found(replace(spec, activities=(thread,))) == ['CC121:70 note']


def test_those_of_the_unit_that_end_it_too_are_named() -> None:
    (wait,) = calls(None, call='Condition.wait')
    wait = replace(wait, wakers=(Waker(by='drain', after=0), Waker(by=OUTSIDE)))
    spec = unit(threads(2), timer('feed', blocking=(wait,)), timer('drain'))
    assert only(spec, 'CC121').message.endswith(
        'and waits forever unless drain or something outside its executor ends it'
    )


def serving(*locks: str) -> Activity:
    on = Unknown('result of websockets.serve, which is not scanned')
    wait = Blocking(call='await', on=on, source=at(60), held=locks)
    return Activity(name='serve', kind=ActivityKind.THREAD, blocking=(wait,))


def test_a_thread_that_waits_in_code_of_others_is_told_where_somebody_needs_it() -> None:
    spec = unit(ONE_THREAD, timer('feed'))
    assert found(replace(spec, activities=(serving(),))) == []
    assert found(replace(spec, activities=(serving('lock'),))) == ['CC120:60 note']
    join = Blocking(call='Thread.join', source=at(70), wakers=(Waker(by='serve'),))
    needing = unit(ONE_THREAD, timer('feed', blocking=(join,)))
    assert 'CC120:60 note' in found(replace(needing, activities=(serving(),)))


def test_a_time_out_ends_it_in_any_case() -> None:
    waits = calls('jobs', call='Barrier.wait', seconds=0.5)
    assert found(unit(threads(2), timer('feed', blocking=waits))) == []


def test_what_earlier_runs_may_have_used_up_is_told() -> None:
    waits = (places_by('leave'),)
    assert found(unit(ONE_THREAD, timer('dock', blocking=waits), timer('leave'))) == [
        'CC120:40 note'
    ]


def test_whoever_gives_back_what_it_takes_uses_up_nothing() -> None:
    assert found(unit(threads(2), timer('dock', blocking=(places_by('dock'),)))) == []


def places_by(waker: str) -> Blocking:
    """A wait for one of two places, which a callback gives back."""
    (wait,) = calls(None, call='Semaphore.acquire')
    gives = Waker(by=waker, after=1 if waker == 'dock' else 0)
    return replace(wait, resource='places', needs=Needs.EACH, initial=2, wakers=(gives,))


def test_a_spin_of_a_node_that_nothing_else_serves_rests_on_who_answers_it() -> None:
    elsewhere = Unknown('an entity of another executor')
    spin = Blocking(call='rclpy.spin_until_future_complete', on=elsewhere, source=at(40))
    future = replace(spin, call='spin for future', wakers=(Waker(by=OUTSIDE),))
    told = (replace(spin, wakers=(Waker(by=TIME),)), future)
    assert found(unit(threads(2), timer('feed', blocking=(spin,)))) == ['CC120:40 note']
    finding = only(unit(threads(2), timer('feed', blocking=told)), 'CC121')
    assert finding.message == (
        'feed waits in a nested spin without a time-out, and waits forever unless something '
        'outside its executor ends it'
    )
    assert found(unit(threads(2), timer('feed', blocking=told))) == ['CC121:40 note']


def test_a_loop_for_an_answer_rests_on_who_gives_it() -> None:
    loop = Blocking(call=ANSWER_LOOP, source=at(40), wakers=(Waker(by=OUTSIDE),))
    finding = only(unit(threads(2), timer('feed', blocking=(loop,))), 'CC121')
    assert finding.message.startswith('feed waits in a loop for an answer without a time-out')


def spun_until(*callbacks: Callback, **facts: Any) -> Spec:
    """A node whose `main` spins until a thread has completed a future."""
    spin = Blocking(
        call='rclpy.spin_until_future_complete',
        source=at(40),
        resource='done',
        foreign=True,
        wakers=(Waker(by='load', after=1),),
        **facts,
    )
    return replace(unit(ONE_THREAD, *callbacks), set_up=(spin,))


@pytest.mark.parametrize('release', [None, '3.3.22', 'humble'])
def test_a_spin_until_a_thread_is_done_may_last_on_humble(release: str | None) -> None:
    finding = only(replace(spun_until(subscription('feed')), rclpy=release), 'CC120')
    assert finding.place == at(40)
    assert finding.message.endswith(
        'before rclpy 5.0.1 (Humble) the spin ends only once a callback is served after that'
    )


def test_it_ends_where_the_future_is_asked_or_a_timer_is_served_or_its_time_is_over() -> None:
    assert found(replace(spun_until(subscription('feed')), rclpy='7.1.6')) == []
    assert found(replace(spun_until(timer('feed')), rclpy='3.3.22')) == []
    once = replace(timer('feed'), one_shot=True)
    assert found(replace(spun_until(once), rclpy='3.3.22')) == ['CC120:40 note']
    assert found(replace(spun_until(once, seconds=1.0), rclpy='3.3.22')) == []


def test_functions_of_one_file_that_nobody_calls_are_told_together() -> None:
    (wait,) = calls(None, call='busy wait')
    uncalled = [
        replace(
            wait,
            resource=f'client_{name}',
            source=Place(file, line, 1),
            escapes=Unknown(f'no known code calls {name}'),
        )
        for file, line, name in (
            ('arm.py', 3, 'home'),
            ('arm.py', 5, 'lift'),
            ('arm.py', 7, 'open'),
            ('arm.py', 9, 'shut'),
            ('base.py', 4, 'turn'),
        )
    ]
    spec = replace(unit(threads(2), timer('feed')), set_up=tuple(uncalled))
    arm, base = findings_of([spec], [], [None])
    assert arm.message == (
        'not decided: home, lift, open and 1 more may wait, here in a busy loop for client_home, '
        'and no known code calls them'
    )
    assert [each.place.line for each in arm.related] == [5, 7, 9]
    assert base.message == (
        'not decided: turn may wait, here in a busy loop for client_turn, and no known code '
        'calls it'
    )


def test_an_answer_that_a_branch_may_not_pass_on_is_told_once() -> None:
    (wait,) = calls('moving', call='polling loop')
    maybe = (Waker(by='pose', conditional=True),)
    wait = replace(wait, on=None, resource='moving', answer_to='rotate', wakers=maybe)
    spec = unit(threads(2), timer('turn', blocking=(wait,)), subscription('pose', 'other'))
    verification = verify_unit(close(spec), Options(profile=Profile.RCLPY))
    assert found(spec, verification) == ['CC120:40 note']


def test_a_loop_without_end_is_said_to_go_on() -> None:
    (wait,) = calls(None, call='endless loop')
    reason = 'only an exception or the end of the program ends it'
    wait = replace(wait, escapes=Unknown(reason))
    finding = only(unit(threads(2), timer('feed', blocking=(wait,))), 'CC120')
    assert finding.message == (f'not decided: feed waits in a loop without end, and {reason}')
