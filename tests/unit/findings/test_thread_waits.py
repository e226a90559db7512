"""Waits of threads of the program's own, and of main: decided or reported, as of callbacks."""

from __future__ import annotations

from dataclasses import replace

import finding_units
import pytest
from finding_units import ONE_THREAD, at, calls, subscription, threads, timer, unit

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.close import close
from ros2cc_extract.spec.effects import OUTSIDE, TIME, Act, Blocking, Waker
from ros2cc_extract.spec.model import Activity, ActivityKind, Callback, Spec
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options
from ros2cc_extract.verify.unit import verify_unit


def found(spec: Spec) -> list[str]:
    return finding_units.found(spec, judged(spec))


def only(spec: Spec, code: str) -> Finding:
    return finding_units.only(spec, code, judged(spec))


def judged(spec: Spec) -> Verification:
    return verify_unit(close(spec), Options(profile=Profile.RCLPY, structural=False))


def thread(name: str = 'work', *blocking: Blocking, **facts: object) -> Activity:
    return Activity(
        name=name,
        kind=ActivityKind.THREAD,
        function=f'arm.Arm.{name}',
        node='arm',
        blocking=blocking,
        source=at(20),
        **facts,  # type: ignore[arg-type]
    )


def beside(*activities: Activity, callbacks: tuple[Callback, ...] = ()) -> Spec:
    return replace(
        unit(ONE_THREAD, *(callbacks or (timer('tick', source=at(10)),))), activities=activities
    )


def event(*wakers: Waker, line: int = 60, **facts: object) -> Blocking:
    (wait,) = calls(None, call='Event.wait')
    facts = {'resource': 'full', **facts}
    return replace(wait, wakers=wakers, source=at(line), **facts)  # type: ignore[arg-type]


def takes(*order: str, line: int) -> tuple[Act, ...]:
    """Locks that are taken one inside the other."""
    return tuple(Act(name=n, source=at(line + i), held=order[:i]) for i, n in enumerate(order))


def test_a_thread_that_nobody_wakes_waits_for_ever() -> None:
    spec = beside(thread('work', event()))
    assert found(spec) == ['CC109:60']
    assert only(spec, 'CC109').message == (
        'thread work waits in Event.wait for full, but nothing ends that wait: it waits forever'
    )


def test_a_thread_that_a_callback_wakes_goes_on() -> None:
    assert found(beside(thread('work', event(Waker(by='tick', after=0))))) == []


def test_what_others_get_before_does_not_keep_the_waker_from_coming() -> None:
    others = tuple(subscription(f'on_{name}', 'free') for name in ('left', 'right', 'top'))
    spec = beside(
        thread('work', event(Waker(by='tick', after=0))), callbacks=(timer('tick'), *others)
    )
    assert found(replace(spec, executor=threads(2))) == []


def test_a_time_out_ends_the_wait_of_a_thread() -> None:
    assert found(beside(thread('work', event(Waker(by=TIME))))) == []


def test_what_nobody_knows_of_a_thread_is_told() -> None:
    wait = event(escapes=Unknown('full is passed to plant.connect'))
    assert found(beside(thread('work', wait))) == ['CC120:60 note']


def test_what_another_program_ends_for_a_thread_is_told() -> None:
    spec = beside(thread('work', event(Waker(by=OUTSIDE))))
    assert found(spec) == ['CC121:60 note']
    assert only(spec, 'CC121').message.startswith('thread work waits in Event.wait for full')


@pytest.mark.parametrize(
    ('call', 'facts', 'expected'),
    [
        ('socket.recvfrom', {'daemon': True, 'loops': True}, []),
        ('sys.stdin.read', {'daemon': True, 'loops': True}, []),
        ('Popen.wait', {'daemon': True}, []),
        # The program waits for it at its end; or it does something else; or others need it.
        ('socket.recvfrom', {'loops': True}, ['CC121:60 note']),
        ('socket.recvfrom', {'daemon': True}, ['CC121:60 note']),
        ('requests.post', {'daemon': True, 'loops': True}, ['CC121:60 note']),
    ],
)
def test_a_daemon_that_only_listens_holds_nobody_up(
    call: str, facts: dict[str, bool], expected: list[str]
) -> None:
    listener = thread('work', event(Waker(by=OUTSIDE), call=call, resource=None), **facts)
    assert found(beside(listener)) == expected
    held = replace(listener, blocking=(replace(listener.blocking[0], held=('lock',)),))
    assert found(beside(held)) == ['CC121:60 note']


def test_a_callback_that_waits_for_the_lock_of_a_waiting_thread() -> None:
    """Each waits for the other; reported where the callback takes the lock."""
    work = thread(
        'work',
        event(Waker(by='tick', after=0, held=('lock',)), held=('lock',)),
        locks=takes('lock', line=59),
    )
    tick = timer('tick', locks=takes('lock', line=40))
    spec = beside(work, callbacks=(tick,))
    assert found(spec) == ['CC109:40']
    assert only(spec, 'CC109').message == (
        'tick waits in Lock.acquire for the lock of work, but thread work, which ends it, itself '
        'waits for full: it waits forever'
    )


def test_locks_of_a_thread_and_a_callback_in_opposite_order() -> None:
    spec = beside(
        thread('work', locks=takes('a', 'b', line=60)),
        callbacks=(timer('tick', locks=takes('b', 'a', line=40)),),
    )
    assert found(spec) == ['CC111:41']
    assert only(spec, 'CC111').message == (
        'tick holds b and waits for a, and thread work may hold a and wait for b at the same '
        'time: both wait forever'
    )


def test_a_thread_that_takes_one_lock_twice() -> None:
    own = (Act(name='a', source=at(60)), Act(name='a', source=at(61), held=('a',)))
    assert found(beside(thread('work', locks=own))) == ['CC111:61']
