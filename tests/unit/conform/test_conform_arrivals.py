"""An events executor serves what arrives in its order; a trace does not show it, feeders do."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest

from ros2cc_extract.conform.arrivals import Arrival
from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.conform.unit import Comparison, compare
from ros2cc_extract.conform.wording import say_observation
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)
from tests.conformance.planted import newest_event_first, one_event_for_each, served_by_kind

EXECUTOR, NODE = 1, 'node'
KINDS = {
    'tick': EntityKind.TIMER,
    'plan': EntityKind.SERVICE,
    'on_joint': EntityKind.SUBSCRIPTION,
}
NUMBERS = {name: number for number, name in enumerate(KINDS, start=2)}
Told = tuple[str, int, int | None]
"""Whom it was handed over to, from when until when."""


def unit() -> Spec:
    callbacks = tuple(
        Callback(name=name, type=kind.published_type, group='g', entity=kind, function=name)
        for name, kind in KINDS.items()
    )
    return Spec(
        name='unit',
        callbacks=callbacks,
        groups=(CallbackGroup(name='g', type=GroupType.EXCLUSIVE),),
        executor=Executor(name='executor', kind='EventsExecutor', threads=('t0',)),
    )


def trace(*runs: tuple[str, int, int]) -> Trace:
    """Runs of callbacks, from and until."""
    subjects = [Subject(EXECUTOR, 'executor', None, None, None, 'EventsExecutor', None)]
    subjects += [
        Subject(NUMBERS[name], kind.value, NODE, 9, EXECUTOR, name, None)
        for name, kind in KINDS.items()
    ]
    events = [
        Event(clock, 100, what, NUMBERS[name])
        for name, begin, end in runs
        for clock, what in ((begin, 'begin'), (end, 'end'))
    ]
    return Trace(1, '9.1.2', 0, {}, {each.number: each for each in subjects}, tuple(events))


def compared(
    runs: Sequence[tuple[str, int, int]], told: Sequence[Told], edit: Callable[[str], str] = str
) -> Comparison:
    arrivals = tuple(
        Arrival(callback=name, thread=0, earliest_ns=earliest, latest_ns=latest)
        for name, earliest, latest in told
    )
    return compare(trace(*runs), EXECUTOR, unit(), arrivals=arrivals, edit=edit)


#: While ``tick`` runs, a request arrives, and then two messages.
BUSY = [('tick', 10, 50), ('plan', 60, 70), ('on_joint', 80, 90), ('on_joint', 91, 95)]
TOLD: list[Told] = [('plan', 20, 21), ('on_joint', 30, 31), ('on_joint', 32, 33)]


def test_in_the_order_of_arrival() -> None:
    assert compared(BUSY, TOLD).answer.outcome is Outcome.CONFORMS


def test_in_another_order() -> None:
    runs = [('tick', 10, 50), ('on_joint', 60, 70), ('plan', 80, 90)]
    found = compared(runs, TOLD)
    assert found.answer.outcome is Outcome.DIVERGES
    assert found.answer.next is not None
    told = (found.answer.next.clock_ns, say_observation(found.answer.next, found.unit.spec))
    assert told == (60, 'on_joint starts')


@pytest.mark.parametrize('plant', [served_by_kind, newest_event_first, one_event_for_each])
def test_of_a_wrong_model(plant: Callable[[str], str]) -> None:
    assert compared(BUSY, TOLD, plant).answer.outcome is Outcome.DIVERGES


def test_what_never_arrived_is_not_served() -> None:
    found = compared([*BUSY, ('plan', 100, 110)], TOLD)
    assert found.answer.outcome is Outcome.DIVERGES
    assert found.answer.steps == len(TOLD) + 2 * len(BUSY) + 1  # and the timer's own arrival


def test_a_timer_is_due_whenever_that_fits() -> None:
    """Nothing reports it: here before the message that is served after it."""
    runs = [('plan', 10, 50), ('tick', 60, 70), ('on_joint', 80, 90)]
    told: list[Told] = [('plan', 5, 6), ('on_joint', 30, 31)]
    found = compared(runs, told)
    assert found.answer.outcome is Outcome.CONFORMS
    words = [say_observation(each, found.unit.spec) for each in found.answer.path]
    assert words == [
        'something arrives for plan',
        'plan starts',
        'something arrives for tick',
        'something arrives for on_joint',
        'plan ends',
        'tick starts',
        'tick ends',
        'on_joint starts',
        'on_joint ends',
    ]


def test_a_timer_is_not_due_twice_before_it_is_served() -> None:
    """Two runs of it before a message that arrived before the first."""
    runs = [('plan', 10, 50), ('tick', 60, 70), ('tick', 71, 75), ('on_joint', 80, 90)]
    told: list[Told] = [('plan', 5, 6), ('on_joint', 30, 31)]
    assert compared(runs, told).answer.outcome is Outcome.DIVERGES


def test_a_message_on_its_way_arrives_later() -> None:
    """The same, if only its being served shows that it had arrived."""
    runs = [('plan', 10, 50), ('tick', 60, 70), ('tick', 71, 75), ('on_joint', 80, 90)]
    told: list[Told] = [('plan', 5, 6), ('on_joint', 30, None)]
    assert compared(runs, told).answer.outcome is Outcome.CONFORMS


def test_on_their_way_messages_keep_their_order() -> None:
    runs = [('tick', 10, 50), ('on_joint', 60, 70), ('plan', 80, 90)]
    told: list[Told] = [('plan', 20, None), ('on_joint', 30, None)]
    assert compared(runs, told).answer.outcome is Outcome.DIVERGES


def test_what_was_not_served_yet_came_after_what_was() -> None:
    runs = [('plan', 10, 50), ('tick', 60, 70)]
    told: list[Told] = [('plan', 5, 6), ('on_joint', 30, 31)]
    assert compared(runs, told).answer.outcome is Outcome.CONFORMS


def test_what_was_last_may_still_be_on_its_way() -> None:
    runs = [('tick', 10, 50), ('plan', 60, 70), ('tick', 80, 90)]
    told: list[Told] = [('plan', 20, None), ('on_joint', 30, None)]
    assert compared(runs, told).answer.outcome is Outcome.CONFORMS


def test_what_was_passed_by_something_later_was_lost() -> None:
    runs = [('tick', 10, 50), ('plan', 60, 70), ('plan', 80, 90)]
    told: list[Told] = [('plan', 20, None), ('on_joint', 30, None), ('plan', 40, None)]
    assert compared(runs, told).answer.outcome is Outcome.DIVERGES
