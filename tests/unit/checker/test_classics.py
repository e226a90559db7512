"""Models of other people's problems, with known answers."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind, Fairness
from tests.support.classics import bounded_buffer, broken_lock, peterson, philosophers
from tests.support.small import ask, holds, labels_of

ENGINES = [EngineKind.REFERENCE, EngineKind.AUTO]


@pytest.mark.parametrize('engine', ENGINES)
def test_peterson_excludes_and_never_deadlocks(engine: EngineKind) -> None:
    assert holds(
        peterson(),
        'A[] not (P0.critical and P1.critical)',
        'A[] not deadlock',
        'E<> P0.critical and P1.waiting',
        engine=engine,
    ) == [True, True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_peterson_lets_everybody_in_only_if_everybody_moves(engine: EngineKind) -> None:
    query = 'P0.waiting --> P0.critical'
    assert holds(peterson(), query, engine=engine) == [False]
    assert holds(peterson(), query, engine=engine, fairness=Fairness.WEAK) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_broken_lock_is_broken_in_four_steps(engine: EngineKind) -> None:
    result = ask(broken_lock(), 'A[] not (P0.critical and P1.critical)', engine=engine)
    answer = result.answers[0]
    assert answer.verdict.value == 'not satisfied'
    assert answer.path is not None
    assert sorted(labels_of(answer.path.steps)) == [
        'P0:idle->sees',
        'P0:sees->critical',
        'P1:idle->sees',
        'P1:sees->critical',
    ]


@pytest.mark.parametrize('engine', ENGINES)
def test_philosophers_deadlock_after_one_fork_each(engine: EngineKind) -> None:
    result = ask(philosophers(4, one_left_handed=False), 'A[] not deadlock', engine=engine)
    path = result.answers[0].path
    assert path is not None
    assert set(path.steps[-1].state.locations.values()) == {'has_one'}
    assert len(path.steps) == 4


@pytest.mark.parametrize('engine', ENGINES)
def test_one_left_handed_philosopher_avoids_the_deadlock(engine: EngineKind) -> None:
    assert holds(
        philosophers(4, one_left_handed=True),
        'A[] not deadlock',
        'A[] not (Philosopher(0).eating and Philosopher(1).eating)',
        'E<> Philosopher(0).eating and Philosopher(2).eating',
        'E<> forall (i : id_t) fork[i]',
        engine=engine,
    ) == [True, True, True, True]


@pytest.mark.parametrize('engine', ENGINES)
def test_bounded_buffer_keeps_the_order(engine: EngineKind) -> None:
    assert holds(
        bounded_buffer(3),
        'A[] not Consumer.error',
        'A[] used <= 3',
        'E<> used == 3',
        'A[] not deadlock',
        engine=engine,
    ) == [True, True, True, True]
