"""Committed chains: what is not stored, and that nothing is lost by it."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Limits,
    Model,
    Query,
    Reductions,
    Verdict,
    check,
)
from ros2cc_extract.checker.engines.search import NO_REDUCTIONS, Symmetry
from tests.support.small import ask, automaton, labels_of, network, single

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

CHAINS = Reductions(dead=False, symmetry=Symmetry.NEVER)


def answer(
    model: Model, *formulas: str, reductions: Reductions = CHAINS, limits: Limits | None = None
) -> CheckResult:
    return check(
        model,
        [Query(formula, '', None) for formula in formulas],
        engine=EngineKind.NATIVE,
        reduction=reductions,
        limits=limits or Limits(),
    )


def steps(result: CheckResult) -> list[str]:
    path = result.answers[0].path
    assert path is not None
    return labels_of(path.steps)


ROUND = """a C:b C:c d
a -> b
b -> c
c -> d
d -> a"""


def test_committed_states_are_not_stored() -> None:
    assert answer(single(ROUND)).states == 2
    assert answer(single(ROUND), 'A[] not deadlock').answers[0].verdict is Verdict.SATISFIED


def test_without_reduction_every_state_is_stored() -> None:
    found = ask(single(ROUND), 'A[] not deadlock', reduction=False)
    assert (found.states, found.transitions) == (4, 4)


@pytest.mark.parametrize('query', ['P.a --> P.d', 'A<> P.d', 'E[] not P.d'])
def test_liveness_query_stores_every_state(query: str) -> None:
    assert answer(single(ROUND), 'A[] not deadlock', query).states == 4


def test_witness_within_a_chain_is_told_step_by_step() -> None:
    found = answer(single(ROUND), 'E<> P.c')
    assert steps(found) == ['P:a->b', 'P:b->c']


def test_run_through_several_chains_has_every_step() -> None:
    drawing = 'a C:b c C:d e\na -> b\nb -> c\nc -> d\nd -> e'
    found = answer(single(drawing), 'E<> P.e')
    assert steps(found) == ['P:a->b', 'P:b->c', 'P:c->d', 'P:d->e']


def test_deadlock_within_a_chain_is_found() -> None:
    found = answer(single('a C:b C:c\na -> b\nb -> c'), 'A[] not deadlock')
    assert found.answers[0].verdict is Verdict.NOT_SATISFIED
    assert steps(found) == ['P:a->b', 'P:b->c']


def test_committed_cycle_ends() -> None:
    found = answer(single('a C:b C:c\na -> b\nb -> c\nc -> b'), 'A[] not deadlock')
    assert (found.states, found.complete) == (1, True)
    assert found.answers[0].verdict is Verdict.SATISFIED


def test_initial_state_may_be_committed() -> None:
    found = answer(single('C:a C:b c\na -> b\nb -> a\nb -> c\nc -> c'), 'E<> P.c')
    assert steps(found) == ['P:a->b', 'P:b->c']


def test_few_plain_steps_are_shorter_than_one_long_chain() -> None:
    drawing = """a C:b C:c C:d m z y
    a -> b
    b -> c
    c -> d
    d -> z
    a -> m
    m -> z
    z -> y"""
    found = answer(single(drawing), 'E<> P.y', 'E<> P.d')
    assert steps(found) == ['P:a->m', 'P:m->z', 'P:z->y']
    assert found.answers[1].path is not None
    assert len(found.answers[1].path.steps) == 3


def test_witness_in_a_chain_gives_way_to_a_nearer_one() -> None:
    drawing = """a C:b C:c C:d m n
    a -> b
    b -> c
    c -> d; do: x = 1
    a -> m
    m -> n; do: x = 1"""
    found = answer(single(drawing, declaration='bool x;'), 'E<> x')
    assert steps(found) == ['P:a->m', 'P:m->n']


COUNTING = """a C:b
a -> b
b -> b; guard: n < 100; do: n++
b -> a; guard: n == 100"""


def test_chain_too_long_to_pass_over_is_stored_in_part() -> None:
    found = answer(single(COUNTING, declaration='int[0, 100] n;'), 'E<> n == 100')
    assert len(steps(found)) == 101
    everything = answer(single(COUNTING, declaration='int[0, 100] n;'))
    full = answer(single(COUNTING, declaration='int[0, 100] n;'), reductions=NO_REDUCTIONS)
    assert 2 < everything.states < full.states / 4


def test_chain_of_many_branches_loses_none() -> None:
    drawing = """a C:b c
    a -> b; select: i : int[0, 99]; do: n = i
    b -> c; guard: n == 77"""
    model = single(drawing, declaration='int[0, 99] n;')
    assert steps(answer(model, 'E<> P.c')) == ['P:a->b', 'P:b->c']
    assert answer(model, 'E<> P.b and n == 99').answers[0].verdict is Verdict.SATISFIED
    assert answer(model, 'E<> P.c and n == 76').answers[0].verdict is Verdict.NOT_SATISFIED


def test_two_committed_processes_move_in_any_order() -> None:
    drawing = 'a C:b c\na -> b; sync: go?\nb -> c; do: last = me'
    start = automaton('S', 'a b\na -> b; sync: go!')
    model = network(
        automaton('T', drawing, parameters='const int me'),
        start,
        declaration='broadcast chan go; int[0, 2] last;',
        system='p = T(1); q = T(2); system p, q, S;',
    )
    found = answer(model, 'E<> last == 1 and q.c', 'E<> last == 2 and p.c', 'E<> p.c and q.b')
    assert [a.verdict for a in found.answers] == [Verdict.SATISFIED] * 3
    # Before the start, and the two orders in which the processes arrive.
    assert answer(model).states == 3


def test_chains_that_do_not_pay_are_stored() -> None:
    """Where all states are committed there is nothing between which to pass them over."""
    cycle = '\n'.join(f'l{i} -> l{(i + 1) % 9}' for i in range(9))
    drawing = f'{" ".join(f"C:l{i}" for i in range(9))}\n{cycle}'
    model = network(
        automaton('T', drawing), system='p = T(); q = T(); r = T(); s = T(); system p, q, r, s;'
    )
    full, chains = answer(model, reductions=NO_REDUCTIONS), answer(model)
    assert full.states == 9**4
    assert chains.complete
    assert chains.transitions < 6 * full.transitions


@pytest.mark.parametrize('limit', [1, 2, 3, 5])
def test_limit_counts_stored_states_and_is_exact(limit: int) -> None:
    model = single(COUNTING, declaration='int[0, 100] n;')
    found = answer(model, 'E<> n == 100', limits=Limits(states=limit))
    assert (found.states, found.complete) == (limit, False)
    assert found.answers[0].verdict is Verdict.UNDECIDED


def test_second_run_is_the_same() -> None:
    model = single(COUNTING, declaration='int[0, 100] n;')
    first, second = (answer(model, 'E<> n == 40', 'E<> P.b and n == 7') for _ in range(2))
    assert (first.states, first.transitions) == (second.states, second.transitions)
    assert steps(first) == steps(second)
