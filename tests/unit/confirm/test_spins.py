"""A nested spin that sleeps on beside a timer that is due, as nobody of its executor wakes it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from ros2cc_extract.confirm.judging import confirmed
from ros2cc_extract.confirm.observations import Observations, Sample
from ros2cc_extract.confirm.outcomes import Outcome
from ros2cc_extract.confirm.schedules import Point, Schedule
from ros2cc_extract.extract.live.hang_analysis.samples import Activity, Entity, Frame, Look
from ros2cc_extract.extract.live.hang_analysis.wait_for_graph import explain

FILE, LINE, TIMER, GROUP = '/node.py', 23, 7, 8
SCHEDULE = Schedule(
    code='CC106',
    path=FILE,
    line=LINE,
    message='the node leaves its executor',
    entry=FILE,
    function='main',
    points=(Point(file=FILE, first=LINE, last=LINE),),
    leaves=True,
)
SPIN = Frame(
    number=1,
    file=FILE,
    function='execute',
    called='Mover.execute',
    module='__main__',
    line=LINE,
    at=4,
    position=None,
    item=None,
    objects={},
    endless=True,
    entity=None,
)
DUE = Entity(
    number=TIMER,
    kind='timers',
    cls='Timer',
    node='/mover',
    simulated_clock=False,
    group=GROUP,
    exclusive=True,
    active=None,
    function='Mover.report',
    module='__main__',
    place=None,
    key=None,
    domain=30,
    there=False,
    servers=None,
    pending=frozenset(),
    ready=True,
    cancelled=False,
)


def sample(at: float, timer: Entity, line: int = LINE) -> Sample:
    activity = Activity(name='ThreadPoolExecutor-0_1', frames=(replace(SPIN, line=line),), ident=5)
    look = Look(
        main=1,
        nodes=('/mover',),
        activities=(activity,),
        entities={TIMER: timer},
        executors=(),
        objects={},
        unread=(),
    )
    return Sample(at, (look, look), explain(1, (look, look)))


def judged(*samples: Sample, begins: tuple[float, ...] = ()) -> Outcome | None:
    seen = Observations(reached={0: 1}, samples=list(samples))
    seen.begins = [(at, TIMER) for at in begins]
    found = confirmed(SCHEDULE, seen)
    return None if found is None else found.outcome


def test_it_is_shown_by_a_timer_that_stays_due() -> None:
    seen = Observations(reached={0: 1}, samples=[sample(1.0, DUE), sample(4.0, DUE)])
    found = confirmed(SCHEDULE, seen)
    assert found is not None
    assert found.reason == (
        'spins at line 23 for 3 s and more, and nothing begins, although Mover.report is due'
    )


@pytest.mark.parametrize(
    'timer',
    [
        replace(DUE, ready=False),
        replace(DUE, cancelled=True),
        replace(DUE, active=99),  # somebody else of its group runs
        replace(DUE, simulated_clock=True),
        replace(DUE, module='rclpy.parameter'),
    ],
)
def test_it_is_not_by_one_that_may_wait(timer: Entity) -> None:
    assert judged(sample(1.0, timer), sample(4.0, timer)) is None


def test_it_is_not_where_something_begins_or_the_spin_is_over() -> None:
    assert judged(sample(1.0, DUE), sample(4.0, DUE), begins=(2.0,)) is None
    assert judged(sample(1.0, DUE), sample(4.0, DUE, line=30)) is None
    assert judged(sample(1.0, DUE), sample(2.0, DUE)) is None
