"""Networks with several like processes: every combination of reductions keeps every verdict."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2cc_extract.checker.analyses.symmetry import Family, families
from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Fairness,
    Limits,
    Model,
    Query,
    Reductions,
    check,
    read_model,
)
from ros2cc_extract.checker.engines.search import Symmetry, formulas_of
from ros2cc_extract.checker.network.semantics import Semantics, State
from ros2cc_extract.source_locations import Place
from tests.support.crowds import random_crowd
from tests.support.networks import NETWORKS

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

BLOCK = 25
SMALL = 1000


def crowds(block: int) -> Iterator[tuple[int, Model, list[Query]]]:
    """Yield the networks of a block that plain Python explores in a second or two."""
    for seed in range(block, min(block + BLOCK, NETWORKS)):
        drawn = random_crowd(seed)
        model = read_model(drawn.text, 'crowd.xml')
        size = check(model, (), reduction=False, limits=Limits(states=SMALL))
        if size.complete:
            yield seed, model, [Query(formula, '', None) for formula in drawn.formulas]


def families_of(model: Model, queries: list[Query]) -> tuple[Family, ...]:
    properties = [model.elaboration.query(q.formula, Place('q', 1)) for q in queries]
    return families(model.network, formulas_of(properties))


def summary(result: CheckResult) -> list[tuple[str, bool]]:
    return [(a.verdict.value, a.path is not None) for a in result.answers]


def shortest(result: CheckResult) -> list[int]:
    return [
        len(a.path.steps) for a in result.answers if a.path and a.query.formula[:3] in 'A[] E<>'
    ]


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_every_combination_keeps_verdicts_and_shortest_paths(block: int) -> None:
    for seed, model, queries in crowds(block):
        fairness = Fairness.WEAK if seed % 5 == 4 else Fairness.NONE
        full = check(
            model, queries, engine=EngineKind.REFERENCE, reduction=False, fairness=fairness
        )
        for dead in (False, True):
            for symmetry in (Symmetry.NEVER, Symmetry.ALWAYS):
                reductions = Reductions(dead=dead, symmetry=symmetry)
                reduced = check(model, queries, reduction=reductions, fairness=fairness)
                assert summary(reduced) == summary(full), f'seed {seed}, {reductions}'
                assert shortest(reduced) == shortest(full), f'seed {seed}, {reductions}'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_dead_variables_give_the_same_counts_in_both_engines(block: int) -> None:
    reductions = Reductions(symmetry=Symmetry.NEVER)
    for seed, model, queries in crowds(block):
        counts = {
            (result.states, result.transitions)
            for engine in (EngineKind.REFERENCE, EngineKind.NATIVE)
            for result in [check(model, queries, engine=engine, reduction=reductions)]
        }
        assert len(counts) == 1, f'seed {seed}'


def exchanged(state: State, family: Family, a: int, b: int) -> State:
    """Exchange two members, in their own words: no code of the reduction is used."""
    locations, values = list(state.locations), list(state.values)
    p, q = family.processes[a], family.processes[b]
    locations[p], locations[q] = locations[q], locations[p]
    for s, t in zip(family.parts[a], family.parts[b], strict=True):
        values[s], values[t] = values[t], values[s]
    for slot in family.pointers:
        names = {family.names[a]: family.names[b], family.names[b]: family.names[a]}
        values[slot] = names.get(values[slot], values[slot])
    return State(tuple(locations), tuple(values))


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_exchanging_two_members_exchanges_the_successors(block: int) -> None:
    for seed, model, queries in crowds(block):
        semantics = Semantics(model.network)
        for family in families_of(model, queries):
            if family.picks:
                continue
            order = [semantics.initial()]
            seen = set(order)
            for state in order[:300]:
                targets = {t.target for t in semantics.successors(state)}
                order += targets - seen
                seen |= targets
                for b in range(1, len(family.processes)):
                    twin = exchanged(state, family, 0, b)
                    found = {t.target for t in semantics.successors(twin)}
                    wanted = {exchanged(target, family, 0, b) for target in targets}
                    assert found == wanted, f'seed {seed}'


def test_enough_networks_have_families_that_make_them_smaller() -> None:
    found = smaller = 0
    for _, model, queries in (*crowds(0), *crowds(BLOCK)):
        found += bool(families_of(model, queries))
        counts = [
            check(model, queries, reduction=Reductions(symmetry=symmetry)).states
            for symmetry in (Symmetry.NEVER, Symmetry.ALWAYS)
        ]
        smaller += counts[1] < counts[0]
    assert found >= 20
    assert smaller >= 8
