"""Many suspended runs of one coroutine on a pool are followed without looking at many states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2cc_extract.conform.search import Outcome
from ros2cc_extract.conform.trace import Event, Subject, Trace
from ros2cc_extract.conform.unit import compare
from ros2cc_extract.spec.effects import Blocking
from ros2cc_extract.spec.model import (
    Callback,
    CallbackGroup,
    EntityKind,
    Executor,
    GroupType,
    Spec,
)

EXECUTOR, TICK, CLIENT = range(1, 4)
SPINNING, WORKER, ANOTHER = range(100, 103)
RUNS = 4
KIND = 'MultiThreadedExecutor'


def callback(name: str, kind: EntityKind, *blocking: Blocking) -> Callback:
    return Callback(
        name=name,
        type=kind.published_type,
        group='free',
        entity=kind,
        function=name if kind is EntityKind.TIMER else None,
        coroutine=bool(blocking),
        blocking=blocking,
    )


def unit() -> Spec:
    """A timer that awaits the answers of a client, in a reentrant group, on four threads."""
    return Spec(
        name='unit',
        callbacks=(
            callback('tick', EntityKind.TIMER, Blocking(call='await', on='client')),
            callback('client', EntityKind.CLIENT),
        ),
        groups=(CallbackGroup(name='free', type=GroupType.REENTRANT),),
        executor=Executor(name='executor', kind=KIND, threads=('t0', 't1', 't2', 't3')),
    )


def run(thread: int, subject: int, end: str) -> Iterator[tuple[int, str, int]]:
    """The executor finds something, and a worker runs it."""
    for name, about in (('wait>', EXECUTOR), ('wait<', EXECUTOR), ('collect', subject)):
        yield SPINNING, name, about
    for name in ('begin', 'take', end):
        yield thread, name, subject


def steps() -> Iterator[tuple[int, str, int]]:
    """Runs suspend themselves one after the other; then each gets its answer, and goes on."""
    for _ in range(RUNS):
        yield from run(WORKER, TICK, 'suspend')
    for _ in range(RUNS):
        yield from run(WORKER, CLIENT, 'end')
    for _ in range(RUNS):
        yield from run(ANOTHER, TICK, 'suspend')
        yield WORKER, 'resume', TICK
        yield WORKER, 'end', TICK


def answered_before_the_await() -> Iterator[tuple[int, str, int]]:
    """A run asks, and is kept from its `await` until the answer has been collected."""
    first = [*run(WORKER, TICK, 'suspend')]
    answer = [*run(ANOTHER, CLIENT, 'end')]
    yield from first[:-1]
    yield from answer[:3]
    yield first[-1]
    yield from answer[3:]
    yield WORKER, 'resume', TICK
    yield WORKER, 'end', TICK


def trace(made: Iterable[tuple[int, str, int]]) -> Trace:
    subjects = (
        Subject(EXECUTOR, 'executor', None, None, None, KIND, None),
        Subject(TICK, 'timer', 'node', 9, EXECUTOR, 'tick', None),
        Subject(CLIENT, 'client', 'node', 9, EXECUTOR, 'service', 'service'),
    )
    events = (
        Event(number * 30_000_000, thread, name, about)
        for number, (thread, name, about) in enumerate(made)
    )
    return Trace(1, '9.1.2', 0, {}, {each.number: each for each in subjects}, tuple(events))


def test_each_observation_needs_few_states_however_many_runs_are_suspended() -> None:
    compared = compare(trace(steps()), EXECUTOR, unit())
    assert compared.answer.outcome is Outcome.CONFORMS
    assert compared.answer.seen == len(compared.observations) + 1


def test_an_answer_may_arrive_before_the_await_that_asks_for_it_is_seen() -> None:
    compared = compare(trace(answered_before_the_await()), EXECUTOR, unit())
    assert compared.answer.outcome is Outcome.CONFORMS
