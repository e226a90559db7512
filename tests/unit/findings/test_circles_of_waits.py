"""CC109, not CC103: two callbacks wait for each other, and no number of threads helps."""

from __future__ import annotations

import pytest
from finding_units import at, found, only, threads, timer, unit, verified

from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.spec.effects import Blocking, Waker
from ros2cc_extract.spec.model import Callback


def waiting(name: str, what: str, waker: Waker) -> Callback:
    block = Blocking(call='Event.wait', on=waker.by, source=at(40), resource=what, wakers=(waker,))
    return timer(name, 'free', blocking=(block,))


@pytest.mark.parametrize('number', [2, 4, 8])
def test_a_circle_is_no_matter_of_threads(number: int) -> None:
    spec = unit(
        threads(number),
        waiting('take', 'given', Waker(by='give', after=1)),
        waiting('give', 'taken', Waker(by='take', after=1)),
    )
    assert [f for f in found(spec, verified(spec)) if f.startswith('CC1')] == ['CC109:40']
    finding = only(spec, 'CC109', verified(spec))
    assert finding.severity is Severity.ERROR
    assert finding.message == (
        'take waits in Event.wait for given, but give, which ends it, itself waits for taken: '
        'it waits forever'
    )
    assert finding.help == 'break the circle of take, give: one of them must not wait'


def test_a_signal_before_the_own_wait_breaks_the_circle() -> None:
    spec = unit(
        threads(4),
        waiting('take', 'given', Waker(by='give', after=0)),
        waiting('give', 'taken', Waker(by='take', after=1)),
    )
    assert [f for f in found(spec, verified(spec)) if f.startswith('CC1')] == ['CC103:40 note']
