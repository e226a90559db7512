"""Tasks are served in the order of the version that made the trace, however many there are."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.conform.unit import compare
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

EXECUTOR, TICK, FIRST, SECOND = range(1, 5)
WAKE = [('wait>', EXECUTOR), ('wait<', EXECUTOR)]
SPINNING, WORKER, ANOTHER = range(100, 103)
TASKS = 12


def task(name: str) -> Callback:
    kind = EntityKind.TASK
    return Callback(name=name, type=kind.published_type, group='free', entity=kind, function=name)


def unit(kind: str = 'SingleThreadedExecutor', threads: tuple[str, ...] = ('t0',)) -> Spec:
    """A timer that makes two tasks, or more."""
    timer = EntityKind.TIMER
    tick = Callback(
        name='tick', type=timer.published_type, group='g', entity=timer, function='tick'
    )
    groups = (
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE),
        CallbackGroup(name='free', type=GroupType.REENTRANT, groupless=True),
    )
    executor = Executor(name='executor', kind=kind, threads=threads)
    callbacks = (tick, task('first'), task('second'))
    return Spec(name='unit', callbacks=callbacks, groups=groups, executor=executor)


def trace(rclpy: str | None, *runs: int) -> Trace:
    """Two tasks are made in their order, and run in that of ``runs``."""
    steps = [*WAKE, ('collect', TICK), ('begin', TICK)]
    steps += [('task', FIRST), ('task', SECOND), ('end', TICK)]
    steps += [(name, task) for task in runs for name in ('run', 'pause')]
    return recorded(rclpy, [(100, name, subject) for name, subject in steps])


def recorded(rclpy: str | None, steps: list[tuple[int, str, int]]) -> Trace:
    """Steps, one each 30 ms: thread, event and subject."""
    subjects = (
        Subject(EXECUTOR, 'executor', None, None, None, 'Executor', None),
        Subject(TICK, 'timer', 'node', 9, EXECUTOR, 'tick', None),
        Subject(FIRST, 'task', None, None, EXECUTOR, 'first', None),
        Subject(SECOND, 'task', None, None, EXECUTOR, 'second', None),
    )
    events = tuple(
        Event(number * 30_000_000, thread, name, subject)
        for number, (thread, name, subject) in enumerate(steps)
    )
    return Trace(1, rclpy, 0, {}, {each.number: each for each in subjects}, events)


@pytest.mark.parametrize(
    ('rclpy', 'runs', 'outcome'),
    [
        ('7.1.6', (SECOND, FIRST), Outcome.CONFORMS),
        ('7.1.6', (FIRST, SECOND), Outcome.DIVERGES),
        ('9.1.2', (FIRST, SECOND), Outcome.CONFORMS),
        ('9.1.2', (SECOND, FIRST), Outcome.DIVERGES),
        (None, (SECOND, FIRST), Outcome.CONFORMS),
        (None, (FIRST, SECOND), Outcome.CONFORMS),
    ],
)
def test_waiting_tasks_are_served_in_the_order_of_the_version(
    rclpy: str | None, runs: tuple[int, int], outcome: Outcome
) -> None:
    assert compare(trace(rclpy, *runs), EXECUTOR, unit()).answer.outcome is outcome


def backlog(ticks: int) -> Iterator[tuple[int, str, int]]:
    """Each run of a timer makes a dozen tasks, which stand in the pool's queue before the next."""
    for tick in range(ticks):
        for name, subject in (*WAKE, ('collect', TICK)):
            yield SPINNING, name, subject
        for _ in range(TASKS // 2 if tick else 0):
            for name in ('run', 'pause'):
                yield from ((thread, name, FIRST) for thread in (WORKER, ANOTHER))
        yield from ((WORKER, name, TICK) for name in ('begin', 'take'))
        yield from ((WORKER, 'task', FIRST) for _ in range(TASKS))
        yield WORKER, 'end', TICK


def test_a_backlog_of_tasks_needs_few_states() -> None:
    spec = unit('MultiThreadedExecutor', ('t0', 't1'))
    compared = compare(recorded('7.1.6', list(backlog(6))), EXECUTOR, spec)
    assert compared.answer.outcome is Outcome.CONFORMS
    assert compared.answer.seen == len(compared.observations) + 1


@pytest.mark.parametrize('told', [0, 1])
def test_a_trace_may_end_before_a_task_is_told_of(told: int) -> None:
    """Its maker reports it afterwards; by then it may have run, and the process be gone."""
    steps = [(SPINNING, 'task', FIRST)] * told
    steps += [(SPINNING, name, FIRST) for name in ('run', 'pause')]
    compared = compare(recorded('9.1.2', steps), EXECUTOR, unit())
    assert (compared.answer.outcome, compared.gaps) == (Outcome.CONFORMS, ())
