"""``A<>``, ``E[]`` and leads-to: cycles, dead ends, and time that passes forever."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind, Fairness, Model, Run
from tests.support.small import ask, automaton, holds, labels_of, network, single

ENGINES = [EngineKind.REFERENCE, EngineKind.AUTO]


def path_of(model: Model, formula: str, **options: object) -> Run:
    path = ask(model, formula, **options).answers[0].path  # type: ignore[arg-type]
    assert path is not None
    return path


@pytest.mark.parametrize('engine', ENGINES)
def test_cycle_refutes_eventually(engine: EngineKind) -> None:
    model = single('U:a U:b U:c d\na -> b\nb -> c\nc -> b\nc -> d')
    assert holds(model, 'A<> P.d', 'E[] not P.d', 'A<> P.b', engine=engine) == [False, True, True]
    path = path_of(model, 'A<> P.d', engine=engine)
    assert labels_of(path.steps) == ['P:a->b', 'P:b->c', 'P:c->b']
    assert (path.cycle_start, path.ends) == (1, None)
    assert path.steps[-1].state == path.steps[0].state


@pytest.mark.parametrize('engine', ENGINES)
def test_deadlock_refutes_eventually(engine: EngineKind) -> None:
    model = single('U:a U:b U:c\na -> b\na -> c')
    path = path_of(model, 'A<> P.c', engine=engine)
    assert (labels_of(path.steps), path.ends) == (['P:a->b'], 'deadlock')
    assert holds(model, 'A<> P.c or P.b', engine=engine) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_time_that_may_pass_for_ever_refutes_eventually(engine: EngineKind) -> None:
    lazy = single('a b\na -> b')
    path = path_of(lazy, 'A<> P.b', engine=engine)
    assert (path.steps, path.cycle_start, path.ends) == ((), None, 'idle')
    for eager in ('U:a b\na -> b', 'C:a b\na -> b'):
        assert holds(single(eager), 'A<> P.b', 'E[] P.a', engine=engine) == [True, False]


@pytest.mark.parametrize('engine', ENGINES)
@pytest.mark.parametrize('kind', ['chan', 'broadcast chan'])
def test_enabled_urgent_channel_stops_time(engine: EngineKind, kind: str) -> None:
    sender = automaton('S', 'a b\na -> b; guard: open; sync: c!')
    receiver = automaton('R', 'a b\na -> b; sync: c?')
    for prefix, is_open, expected in (
        ('urgent ', 'true', True),
        ('urgent ', 'false', False),
        ('', 'true', False),
    ):
        model = network(
            sender,
            receiver,
            declaration=f'{prefix}{kind} c; bool open = {is_open};',
            system='system S, R;',
        )
        assert holds(model, 'A<> S.b', engine=engine) == [expected]


@pytest.mark.parametrize('engine', ENGINES)
def test_leads_to_looks_only_behind_its_premise(engine: EngineKind) -> None:
    model = single('U:a U:b U:c U:d\na -> a\na -> b\nb -> c\nc -> a\nc -> d\nd -> d')
    assert holds(
        model, 'P.b --> P.c', 'P.b --> P.a', 'P.a --> P.b', 'P.d --> P.d', 'P.b --> P.d',
        engine=engine,
    ) == [True, False, False, True, False]  # fmt: skip
    path = path_of(model, 'P.b --> P.a', engine=engine)
    assert labels_of(path.steps) == ['P:a->b', 'P:b->c', 'P:c->d', 'P:d->d']
    assert path.cycle_start == 3


@pytest.mark.parametrize('engine', ENGINES)
def test_premise_and_conclusion_in_one_state_is_satisfied(engine: EngineKind) -> None:
    assert holds(single('U:a\na -> a'), 'P.a --> P.a', engine=engine) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_weak_fairness_discards_processes_that_never_move(engine: EngineKind) -> None:
    worker = automaton('W', 'a b\na -> b')
    spinner = automaton('S', 'a\na -> a')
    model = network(worker, spinner, system='system W, S;')
    assert holds(model, 'A<> W.b', 'E[] W.a', engine=engine) == [False, True]
    fair = {'engine': engine, 'fairness': Fairness.WEAK}
    assert holds(model, 'A<> W.b', 'E[] W.a', **fair) == [True, False]


@pytest.mark.parametrize('engine', ENGINES)
def test_weak_fairness_keeps_cycles_that_serve_everybody(engine: EngineKind) -> None:
    chooser = automaton('C', 'a b end\na -> b\nb -> a\nb -> end')
    other = automaton('O', 'a b\na -> b\nb -> a')
    model = network(chooser, other, system='system C, O;')
    path = path_of(model, 'A<> C.end', engine=engine, fairness=Fairness.WEAK)
    assert path.cycle_start is not None
    movers = {e.process for step in path.steps[path.cycle_start :] for e in step.edges}
    assert movers == {'C', 'O'}


@pytest.mark.parametrize('engine', ENGINES)
def test_weak_fairness_is_about_being_enabled_all_the_time(engine: EngineKind) -> None:
    blinker = automaton('B', 'a b\na -> b; do: on = true\nb -> a; do: on = false')
    waiter = automaton('W', 'a b\na -> b; guard: on')
    model = network(blinker, waiter, declaration='bool on;', system='system B, W;')
    fair = {'engine': engine, 'fairness': Fairness.WEAK}
    assert holds(model, 'A<> W.b', **fair) == [False]


@pytest.mark.parametrize('engine', ENGINES)
def test_deadlock_ends_fair_paths_too(engine: EngineKind) -> None:
    model = single('a b c\na -> b\na -> c')
    path = path_of(model, 'A<> P.c', engine=engine, fairness=Fairness.WEAK)
    assert (labels_of(path.steps), path.ends) == (['P:a->b'], 'deadlock')
