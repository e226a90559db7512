"""CC109: a bounded queue or a semaphore is used up, and who gives back is kept from it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from finding_units import ONE_THREAD, at, found, only, threads, timer, unit, verified

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.effects import BY_ITSELF, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, Executor
from ros2cc_extract.verify.results.results import Verdict


def logs(why: str = f'the first 3 {BY_ITSELF}', *givers: str) -> Callback:
    put = Blocking(
        call='Queue.put',
        source=at(41),
        resource='lines (room)',
        needs=Needs.EACH,
        wakers=tuple(Waker(by=giver) for giver in givers),
        escapes=Unknown(why),
    )
    return timer('log', 'arm_default', blocking=(put,))


@pytest.mark.parametrize(
    ('executor', 'group'), [(ONE_THREAD, 'other'), (threads(2), 'arm_default')]
)
def test_who_gives_back_cannot_run_while_somebody_waits(executor: Executor, group: str) -> None:
    spec = unit(executor, logs(f'the first 3 {BY_ITSELF}', 'flush'), timer('flush', group))
    assert [f for f in found(spec) if f.startswith('CC1')] == ['CC109:41 warning']
    finding = only(spec, 'CC109')
    assert finding.severity is Severity.WARNING
    assert finding.message == (
        'log waits in Queue.put for lines (room) once that is used up, and flush cannot '
        'run meanwhile: it waits forever'
    )


@pytest.mark.parametrize(
    ('executor', 'log'),
    [
        (threads(2), logs(f'the first 3 {BY_ITSELF}', 'flush')),
        (ONE_THREAD, logs('it is handed to code that is not followed', 'flush')),
        (ONE_THREAD, logs(f'the first 3 {BY_ITSELF}', 'flush', 'outside')),
    ],
    ids=['it can run', 'somebody else may', 'outside too'],
)
def test_else_it_is_not_said(executor: Executor, log: Callback) -> None:
    spec = unit(executor, log, timer('flush', 'other'))
    assert [f for f in found(spec) if f.startswith('CC109')] == []


def writer(*blocking: Blocking) -> Activity:
    took = Blocking(call='Queue.get', resource='lines', wakers=(Waker(by='log'),))
    return Activity(name='write', kind=ActivityKind.THREAD, blocking=(took, *blocking))


def waits_for(*wakers: str, seconds: float | None = None, call: str = 'Event.wait') -> Blocking:
    by = tuple(Waker(by=each) for each in wakers)
    return Blocking(call=call, resource='acked', wakers=by, seconds=seconds)


def test_a_thread_that_gives_back_may_wait_for_who_cannot_run() -> None:
    spec = unit(ONE_THREAD, logs(f'some {BY_ITSELF}', 'write'), timer('flush', 'other'))
    spec = replace(spec, activities=(writer(waits_for('flush')),))
    finding = only(spec, 'CC109')
    assert finding.severity is Severity.WARNING
    assert finding.message == (
        'log waits in Queue.put for lines (room) once that is used up, and thread write may '
        'then wait for flush, which cannot run meanwhile: it waits forever'
    )


@pytest.mark.parametrize(
    ('executor', 'blocking'),
    [
        (threads(2), waits_for('flush')),
        (ONE_THREAD, waits_for('flush', seconds=1.0)),
        (ONE_THREAD, waits_for('flush', 'outside')),
        (ONE_THREAD, waits_for('time')),
        (ONE_THREAD, waits_for('flush', call='polling loop')),
    ],
    ids=['it can run', 'for some time', 'somebody else may', 'time', 'what may stay so'],
)
def test_else_the_thread_goes_on(executor: Executor, blocking: Blocking) -> None:
    spec = unit(executor, logs(f'some {BY_ITSELF}', 'write'), timer('flush', 'other'))
    spec = replace(spec, activities=(writer(blocking),))
    assert [f for f in found(spec) if f.startswith('CC109')] == []


def takes(*givers: Waker, conditional: bool = False) -> Callback:
    get = Blocking(
        call='Queue.get',
        source=at(51),
        on='goals',
        resource='goals',
        needs=Needs.EACH,
        wakers=givers,
        conditional=conditional,
    )
    return timer('take', 'arm_default', blocking=(get,))


def test_what_is_given_once_serves_one_run() -> None:
    give = replace(timer('give', 'other'), one_shot=True)
    spec = unit(threads(4), takes(Waker(by='give', after=0)), give)
    finding = only(spec, 'CC109', verified(spec))
    assert (finding.severity, finding.message) == (
        Severity.ERROR,
        'take waits in Queue.get for goals, but give runs only once, and an earlier wait uses up '
        'what it does for it: it waits forever',
    )


def test_the_run_shows_what_was_given_and_who_took_it() -> None:
    give = replace(timer('give', 'other'), one_shot=True)
    spec = unit(threads(4), takes(Waker(by='give', after=0)), give)
    run = only(spec, 'CC109', verified(spec)).run
    assert run is not None
    starts_and_ends = [
        (event.kind, event.who)
        for moment in run.moments
        for event in moment.events
        if event.kind in ('start', 'end', 'wait')
    ]
    given, taken = [('start', 'give'), ('end', 'give')], [('start', 'take'), ('end', 'take')]
    assert sorted(starts_and_ends[:4]) == sorted((*given, *taken))
    assert starts_and_ends[4:] == [('start', 'take'), ('wait', 'take')]


@pytest.mark.parametrize(
    ('givers', 'conditional', 'why'),
    [
        (1, True, 'a limited number of times, and data decides which of its runs do so'),
        (8, False, '8 times, and 8 of its runs are looked at'),
    ],
    ids=['a branch may skip the wait', 'more than runs are looked at'],
)
def test_what_no_number_of_runs_shows_is_not_decided(
    givers: int, conditional: bool, why: str
) -> None:
    wakers = (Waker(by='give', after=0, source=at(61 + n)) for n in range(givers))
    give = replace(timer('give', 'other'), one_shot=True)
    spec = unit(threads(4), takes(*wakers, conditional=conditional), give)
    finding = only(spec, 'CC120', verified(spec))
    assert finding.message == (
        'not decided: take waits in Queue.get for goals, and each Queue.get of take uses up what '
        f'is given {why}'
    )
    assert {
        result.reason
        for result in verified(spec).results
        if result.family in ('deadlock', 'progress') and result.verdict is not Verdict.SATISFIED
    } == {f'each Queue.get of take uses up what is given {why}'}


def test_what_is_given_twice_in_one_run_serves_two() -> None:
    give = replace(timer('give', 'other'), one_shot=True)
    wakers = (Waker(by='give', after=0, source=at(41)), Waker(by='give', after=0, source=at(42)))
    spec = unit(threads(4), takes(*wakers), give)
    finding = only(spec, 'CC109', verified(spec))
    assert finding.message.startswith('take waits in Queue.get for goals, but give runs only once')


def test_who_hangs_behind_what_he_gives_serves_one_run() -> None:
    stands = Blocking(call='Event.wait', source=at(42), resource='gone', wakers=())
    give = timer('give', 'other', blocking=(stands,))
    spec = unit(threads(4), takes(Waker(by='give', after=0)), give)
    assert [f for f in found(spec, verified(spec)) if f.startswith('CC109:51')] == ['CC109:51']


@pytest.mark.parametrize(
    ('taker', 'give'),
    [
        (takes(Waker(by='give', after=0)), timer('give', 'other')),
        (
            replace(takes(Waker(by='give', after=0)), one_shot=True),
            replace(timer('give', 'other'), one_shot=True),
        ),
    ],
    ids=['it gives each period', 'each runs once'],
)
def test_who_is_served_each_time_ends(taker: Callback, give: Callback) -> None:
    spec = unit(threads(4), taker, give)
    assert [f for f in found(spec, verified(spec)) if f.startswith('CC1')] == []
