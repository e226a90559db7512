"""Findings about waits where the model of the unit has its say."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import (
    ONE_THREAD,
    at,
    calls,
    client,
    exclusive,
    found,
    only,
    service,
    subscription,
    threads,
    timer,
    unit,
)

from ros2cc_extract.checker.api import Verdict
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import Blocking, Needs, Waker
from ros2cc_extract.spec.model import Executor, Spec, Unresolved
from ros2cc_extract.verify.results.events import Event
from ros2cc_extract.verify.results.evidence import Evidence, Moment, Sentence
from ros2cc_extract.verify.results.results import QueryResult, Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit

RUN = Evidence(start={}, moments=(), cycle_from=None, ends='deadlock')


def progress(verdict: Verdict, *names: str) -> Verification:
    return Verification(
        model='arm',
        profile='rclpy',
        text='compact',
        engine='reference',
        states=1,
        transitions=1,
        seconds=0.0,
        peak_mb=1.0,
        complete=True,
        results=tuple(
            QueryResult(
                family='progress',
                formula='',
                words='',
                callbacks=(name,),
                verdict=verdict,
                reason=None,
                seconds=0.0,
                run=RUN if verdict is Verdict.NOT_SATISFIED else None,
            )
            for name in names
        ),
    )


def own_group(**facts: object) -> Spec:
    return unit(
        threads(2),
        timer('drive', blocking=calls('plan_client', **facts)),
        client('plan_client'),
        subscription('on_stop', 'other'),
    )


def circle(**facts: object) -> Spec:
    names = ('left', 'right', 'left_client', 'right_client')
    return unit(
        threads(4),
        service('on_left', 'left', key='left', blocking=calls('to_right', 40, **facts)),
        service('on_right', 'right', key='right', blocking=calls('to_left', 45)),
        client('to_left', 'left_client', key='left'),
        client('to_right', 'right_client', key='right'),
        groups=tuple(exclusive(name) for name in names),
    )


def test_a_wait_that_the_model_proves_to_end_is_no_finding() -> None:
    assert found(own_group(), progress(Verdict.SATISFIED, 'drive')) == []
    assert found(own_group(), progress(Verdict.UNDECIDED, 'drive')) == ['CC101:40']


def test_that_a_wait_ends_by_its_time_out_is_no_proof_that_its_answer_comes() -> None:
    proven = progress(Verdict.SATISFIED, 'drive')
    assert found(own_group(seconds=1.0), proven) == ['CC101:40 warning']


def test_a_nested_spin_is_in_the_model_too() -> None:
    spins = own_group(call='spin for future')
    assert found(spins, progress(Verdict.SATISFIED, 'drive')) == []
    assert found(spins, progress(Verdict.UNDECIDED, 'drive')) == ['CC101:40']
    assert only(spins, 'CC101', progress(Verdict.NOT_SATISFIED, 'drive')).run is RUN


def test_a_hang_that_rests_on_an_absent_service_is_no_finding_of_the_model() -> None:
    """Another program may offer it; the verdict says so."""
    waits = Event(kind='wait', form='service', who='on_left', thread='thread_0', needed='a')
    told = (Sentence.of('thread_0', waits),)
    moment = Moment(number=1, sentences=told, places=(), changes={})
    stuck = progress(Verdict.NOT_SATISFIED, 'on_left', 'on_right')
    results = (replace(result, run=replace(RUN, moments=(moment,))) for result in stuck.results)
    assert found(circle(), replace(stuck, results=tuple(results))) == []


def test_the_run_of_the_model_is_the_evidence() -> None:
    assert only(own_group(), 'CC101', progress(Verdict.NOT_SATISFIED, 'drive')).run is RUN
    assert only(own_group(), 'CC101').run is None


def judged(spec: Spec) -> Verification:
    return verify_unit(close(spec), Options(profile=Profile.RCLPY, structural=False))


def test_callbacks_that_wait_for_each_other_are_found_by_the_model() -> None:
    assert found(circle()) == []
    finding = only(circle(), 'CC109', judged(circle()))
    assert finding.message == (
        "on_left waits in client.call for client 'right', but on_right, which ends it, itself "
        "waits for client 'left': it waits forever"
    )
    assert finding.subjects == ('on_left', 'on_right', 'to_right')
    assert finding.run is not None
    assert finding.run.closing.startswith('nothing moves any more: ')
    assert [(remark.place, remark.text) for remark in finding.related] == [
        (at(45), 'on_right waits here in client.call')
    ]


def queue_of(*wakers: Waker) -> tuple[Blocking, ...]:
    (wait,) = calls(None, call='Queue.get')
    return (replace(wait, resource='jobs', needs=Needs.EACH, wakers=wakers),)


@pytest.mark.parametrize(
    ('executor', 'group', 'wakers', 'reason'),
    [
        (threads(2), 'other', (), 'nothing ends that wait'),
        (
            threads(2),
            'arm_default',
            (Waker(by='feed'),),
            "feed is in the default group of 'arm', which is closed while drain waits",
        ),
        (
            ONE_THREAD,
            'other',
            (Waker(by='feed'),),
            'feed cannot run: drain holds the only thread of the executor',
        ),
    ],
)
def test_the_general_rule_names_the_cause(
    executor: Executor, group: str, wakers: tuple[Waker, ...], reason: str
) -> None:
    spec = unit(executor, timer('drain', blocking=queue_of(*wakers)), timer('feed', group))
    finding = only(spec, 'CC109', judged(spec))
    assert finding.message == (
        f'drain waits in Queue.get for jobs, but {reason}: it waits forever'
    )
    assert finding.severity is Severity.ERROR


def test_a_hang_that_another_rule_explains_is_told_once() -> None:
    stuck = progress(Verdict.NOT_SATISFIED, 'drive', 'turn')
    spec = unit(
        threads(2),
        timer('drive', blocking=calls('plan_client')),
        client('plan_client'),
        timer('turn', 'other', blocking=calls('plan_client', 45)),
    )
    assert found(spec, stuck) == ['CC101:40']


def test_a_unit_with_a_hole_is_not_judged_by_its_model() -> None:
    hole = Unresolved(subject='x', fact='group', reason='an argument', source=at(3))
    with_hole = replace(circle(), unresolved=(hole,))
    assert found(with_hole, judged(with_hole)) == [
        'CC501:3 note',
        'CC120:40 note',
        'CC120:45 note',
    ]
    no_executor = Executor(name='e', kind=Unknown('none'), threads=('t',))
    without = replace(circle(), executor=no_executor)
    assert found(without, judged(without)) == ['CC120:40 note', 'CC120:45 note']


def test_a_name_that_is_not_known_undoes_no_run() -> None:
    hole = Unresolved(subject='x', fact='topic', reason='an argument', source=at(3))
    spec = replace(circle(), unresolved=(hole,))
    assert found(spec, judged(spec)) == ['CC109:40', 'CC501:3 note']


def test_waiting_for_a_service_to_be_there_needs_no_callback() -> None:
    refuted = progress(Verdict.NOT_SATISFIED, 'drive')
    assert found(own_group(call='wait_for_service'), refuted) == []
    assert found(own_group(call='Condition.wait_for'), refuted) == ['CC101:40']


@pytest.mark.parametrize(('seconds', 'expected'), [(None, Severity.WARNING), (5.0, Severity.NOTE)])
def test_a_service_that_overlaps_itself_weighs_more_where_a_run_shows_that_it_hangs(
    seconds: float | None, expected: Severity
) -> None:
    """Its client in the unit asks, and one outside: two threads are taken."""
    spec = unit(
        threads(2),
        service('quote', 'free', key='quote', blocking=calls('lookup', seconds=seconds)),
        client('lookup', 'free'),
        timer('scan', 'other', coroutine=True, blocking=calls('ask', 60, call='await')),
        client('ask', 'free', key='quote'),
    )
    assert only(spec, 'CC103', judged(spec)).severity is expected


def test_one_limit_is_one_line_however_many_waits_it_leaves_open() -> None:
    waits = (*calls('jobs', 40, call='Event.wait'), *calls('more', 44, call='Event.wait'))
    known = tuple(
        replace(wait, resource=wait.on, wakers=(Waker(by='on_stop'),)) for wait in (*waits, *waits)
    )
    drive, turn = (timer(name, blocking=known) for name in ('drive', 'turn'))
    spec = unit(threads(2), drive, turn, subscription('on_stop', 'other'))
    verdicts = progress(Verdict.UNDECIDED, 'drive', 'turn')
    late = replace(
        verdicts, results=tuple(replace(r, reason='10 s are over') for r in verdicts.results)
    )
    finding = only(spec, 'CC120', late)
    assert finding.message == (
        'not decided: drive, turn wait in Event.wait for jobs and in 1 more place, and 10 s are '
        'over'
    )
    assert finding.subjects == ('drive', 'turn')
    assert [(remark.place, remark.text) for remark in finding.related] == [
        (at(44), 'drive, turn wait here in Event.wait')
    ]
