"""Findings about waits where the model of the unit has its say."""

from __future__ import annotations

from dataclasses import replace

from finding_units import (
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

from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.model import Spec, Unresolved
from ros2cc_extract.verify.events import Event
from ros2cc_extract.verify.evidence import Evidence, Moment, Sentence
from ros2cc_extract.verify.unit import QueryResult, Verdict, Verification

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
    """Another program may offer it; whoever waits is told so by the verdict."""
    waits = Event(kind='wait', form='service', who='on_left', thread='thread_0', needed='a')
    told = (Sentence.of('thread_0', waits),)
    moment = Moment(number=1, sentences=told, places=(), changes={})
    stuck = progress(Verdict.NOT_SATISFIED, 'on_left', 'on_right')
    results = (replace(result, run=replace(RUN, moments=(moment,))) for result in stuck.results)
    assert found(circle(), replace(stuck, results=tuple(results))) == []


def test_the_run_of_the_model_is_the_evidence() -> None:
    assert only(own_group(), 'CC101', progress(Verdict.NOT_SATISFIED, 'drive')).run is RUN
    assert only(own_group(), 'CC101').run is None


def test_callbacks_that_wait_for_each_other_are_found_by_the_model() -> None:
    stuck = progress(Verdict.NOT_SATISFIED, 'on_left', 'on_right')
    assert found(circle()) == []
    finding = only(circle(), 'CC109', stuck)
    assert finding.subjects == ('on_left', 'on_right')
    assert finding.run is RUN
    assert [(remark.place, remark.text) for remark in finding.related] == [
        (at(45), 'on_right waits here in client.call')
    ]


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
    stuck = progress(Verdict.NOT_SATISFIED, 'on_left', 'on_right')
    spec = circle()
    with_hole = type(spec)(**{**vars(spec), 'unresolved': (hole,)})
    assert found(with_hole, stuck) == ['CC501:3 note']
    no_executor = type(spec.executor)(name='e', kind=Unknown('none'), threads=('t',))
    assert found(type(spec)(**{**vars(spec), 'executor': no_executor}), stuck) == []


def test_waiting_for_a_service_to_be_there_needs_no_callback() -> None:
    refuted = progress(Verdict.NOT_SATISFIED, 'drive')
    assert found(own_group(call='wait_for_service'), refuted) == []
    assert found(own_group(call='Condition.wait_for'), refuted) == ['CC101:40']
