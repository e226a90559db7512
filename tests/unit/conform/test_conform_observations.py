"""What a trace says about one unit: whose steps they are, and which of them count."""

from __future__ import annotations

from ros2cc_extract.conform.observations import ASLEEP_NS, Act, Observation, observe
from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.spec.model import (
    EntityKind,
)

EXECUTOR = 1


def subject(
    number: int,
    kind: EntityKind,
    name: str,
    key: str | None = None,
    node: str | None = 'arm',
    executor: int | None = EXECUTOR,
) -> Subject:
    return Subject(number, kind.value, node, 9, executor, name, key)


def trace_of(*subjects: Subject, events: tuple[Event, ...] = ()) -> Trace:
    return Trace(7, '9.1.2', 0, {}, {each.number: each for each in subjects}, events)


SUBSCRIPTION, TIMER, CLIENT = EntityKind.SUBSCRIPTION, EntityKind.TIMER, EntityKind.CLIENT


TICK, ON, GUARD, TASK, PLAN = 2, 3, 4, 5, 6
SUBJECTS = (
    Subject(EXECUTOR, 'executor', None, None, None, 'MultiThreadedExecutor', None),
    subject(TICK, TIMER, 'tick'),
    subject(ON, SUBSCRIPTION, 'on', 'joints'),
    subject(GUARD, EntityKind.GUARD_CONDITION, 'guard'),
    subject(TASK, EntityKind.TASK, 'task', node=None),
    subject(PLAN, CLIENT, 'plan', 'plan'),
)
PLACES = {TICK: 0, ON: 1, GUARD: 2, TASK: 3, PLAN: 4}
SPIN, WORKER = 100, 101


def observed(*steps: tuple[int, str, int]) -> tuple[Observation, ...]:
    """Steps of the trace, one each nanosecond: thread, event and subject."""
    events = tuple(
        Event(clock, thread, name, number) for clock, (thread, name, number) in enumerate(steps)
    )
    return observe(trace_of(*SUBJECTS, events=events), EXECUTOR, PLACES)


def seen(
    act: Act, callback: int | None, thread: int, clock_ns: int, **more: object
) -> Observation:
    values = {'earliest_ns': clock_ns, **more}
    return Observation(act=act, callback=callback, thread=thread, clock_ns=clock_ns, **values)  # type: ignore[arg-type]


def test_a_wake_up_has_found_what_is_collected_after_it() -> None:
    steps = [(SPIN, 'wait>', EXECUTOR), (SPIN, 'wait<', EXECUTOR)]
    steps += [(SPIN, 'collect', TICK), (SPIN, 'collect', ON)]
    assert observed(*steps) == (
        seen(Act.WAKE, None, SPIN, 1, earliest_ns=0, found=frozenset({0, 1})),
        seen(Act.COLLECT, 0, SPIN, 2),
        seen(Act.COLLECT, 1, SPIN, 3),
    )


def test_who_collects_long_after_its_last_step_may_have_slept() -> None:
    woken = [Event(0, SPIN, 'wait>', EXECUTOR), Event(1, SPIN, 'wait<', EXECUTOR)]
    late = Event(1 + ASLEEP_NS, SPIN, 'collect', TICK)
    trace = trace_of(*SUBJECTS, events=(*woken, late))
    assert observe(trace, EXECUTOR, PLACES)[1:] == (
        seen(Act.COLLECT, 0, SPIN, 1 + ASLEEP_NS, earliest_ns=1),
    )


def test_an_answer_is_there_before_the_end_of_the_client_is_told() -> None:
    steps = [(WORKER, 'begin', PLAN), (SPIN, 'begin', ON), (SPIN, 'end', ON)]
    assert observed(*steps, (WORKER, 'end', PLAN)) == (
        seen(Act.BEGIN, 4, WORKER, 0),
        seen(Act.BEGIN, 1, SPIN, 1),
        seen(Act.END, 1, SPIN, 2),
        seen(Act.END, 4, WORKER, 3, earliest_ns=0),
    )


def test_a_wait_for_nothing_is_left_out() -> None:
    wait = [(SPIN, 'wait>', EXECUTOR), (SPIN, 'wait<', EXECUTOR)]
    steps = [*wait, *wait, (SPIN, 'collect', ON)]
    assert [each.clock_ns for each in observed(*steps)] == [3, 4]


def test_a_take_belongs_to_the_begin_before_it() -> None:
    steps = [(WORKER, 'begin', ON), (SPIN, 'collect', TICK), (WORKER, 'take', ON)]
    assert observed(*steps, (WORKER, 'end', ON)) == (
        seen(Act.BEGIN, 1, WORKER, 0, takes=True),
        seen(Act.COLLECT, 0, SPIN, 1),
        seen(Act.END, 1, WORKER, 3),
    )


def test_a_take_of_something_else_stands_alone() -> None:
    steps = [(WORKER, 'begin', TICK), (WORKER, 'take', ON)]
    assert [each.act for each in observed(*steps)] == [Act.BEGIN, Act.TAKE]


def test_a_guard_condition_has_nothing_to_take() -> None:
    assert observed((WORKER, 'begin', GUARD), (WORKER, 'take', GUARD)) == (
        seen(Act.BEGIN, 2, WORKER, 0),
    )


def test_a_task_may_have_been_made_since_the_last_step_of_its_maker() -> None:
    steps = [(WORKER, 'begin', ON), (SPIN, 'collect', TICK), (WORKER, 'task', TASK)]
    assert observed(*steps, (SPIN, 'run', TASK), (SPIN, 'pause', TASK)) == (
        seen(Act.BEGIN, 1, WORKER, 0),
        seen(Act.COLLECT, 0, SPIN, 1),
        seen(Act.ARRIVE, 3, WORKER, 2, earliest_ns=0, is_task=True),
        seen(Act.BEGIN, 3, SPIN, 3, is_task=True),
        seen(Act.PAUSE, 3, SPIN, 4, is_task=True),
    )


def test_what_is_in_no_place_and_what_no_model_has_is_left_out() -> None:
    assert observed((WORKER, 'begin', 77), (WORKER, 'submit', ON), (WORKER, 'run', ON)) == ()
