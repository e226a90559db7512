"""Tasks that wait are served in the order of the version that made the trace."""

from __future__ import annotations

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


def task(name: str) -> Callback:
    kind = EntityKind.TASK
    return Callback(name=name, type=kind.published_type, group='free', entity=kind, function=name)


def unit() -> Spec:
    """A timer that makes two tasks."""
    timer = EntityKind.TIMER
    tick = Callback(
        name='tick', type=timer.published_type, group='g', entity=timer, function='tick'
    )
    groups = (
        CallbackGroup(name='g', type=GroupType.EXCLUSIVE),
        CallbackGroup(name='free', type=GroupType.REENTRANT, groupless=True),
    )
    executor = Executor(name='executor', kind='SingleThreadedExecutor', threads=('t0',))
    callbacks = (tick, task('first'), task('second'))
    return Spec(name='unit', callbacks=callbacks, groups=groups, executor=executor)


def trace(rclpy: str | None, *runs: int) -> Trace:
    """Two tasks are made in their order, and run in that of ``runs``."""
    steps = [('wait>', EXECUTOR), ('wait<', EXECUTOR), ('collect', TICK), ('begin', TICK)]
    steps += [('task', FIRST), ('task', SECOND), ('end', TICK)]
    steps += [(name, task) for task in runs for name in ('run', 'pause')]
    subjects = (
        Subject(EXECUTOR, 'executor', None, None, None, 'SingleThreadedExecutor', None),
        Subject(TICK, 'timer', 'node', 9, EXECUTOR, 'tick', None),
        Subject(FIRST, 'task', None, None, EXECUTOR, 'first', None),
        Subject(SECOND, 'task', None, None, EXECUTOR, 'second', None),
    )
    events = (Event(clock, 100, name, subject) for clock, (name, subject) in enumerate(steps))
    return Trace(1, rclpy, 0, {}, {each.number: each for each in subjects}, tuple(events))


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
