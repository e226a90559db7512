"""CC109: a bounded queue or a semaphore is used up, and who gives back is kept from it."""

from __future__ import annotations

import pytest
from finding_units import ONE_THREAD, at, found, only, threads, timer, unit

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.places import Unknown
from ros2cc_extract.spec.deeds import BY_ITSELF, Blocking, Needs, Waker
from ros2cc_extract.spec.model import Callback, Executor


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
        'log waits in Queue.put for lines (room) once nothing of it is left, and flush cannot '
        'run meanwhile: it waits for ever'
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
