"""The native core and the reference give the same verdicts, counts and replayable paths."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Fairness,
    Limits,
    Query,
    check,
    read_model,
)
from ros2cc_extract.checker.network.semantics import Semantics
from tests.support.networks import NETWORKS, RandomModel, random_model

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

BLOCK = 25
SMALL = 3000


def answers(
    model: RandomModel, engine: EngineKind, fairness: Fairness, *, reduction: bool
) -> CheckResult:
    network = read_model(model.text, 'random.xml')
    queries = [Query(formula, '', None) for formula in model.formulas]
    return check(network, queries, engine=engine, fairness=fairness, reduction=reduction)


def summary(result: CheckResult) -> list[tuple[str, bool]]:
    return [(a.verdict.value, a.path is not None) for a in result.answers]


def shortest(result: CheckResult) -> list[int]:
    """Lengths of the paths that are shortest by promise: those to a single state."""
    return [
        len(a.path.steps) for a in result.answers if a.path and a.query.formula[:3] in 'A[] E<>'
    ]


def plain_counts(model: RandomModel) -> tuple[int, int]:
    semantics = Semantics(read_model(model.text, 'random.xml').network)
    order, transitions = [semantics.initial()], 0
    seen = set(order)
    for state in order:
        for transition in semantics.successors(state):
            transitions += 1
            if transition.target not in seen:
                seen.add(transition.target)
                order.append(transition.target)
    return len(order), transitions


def models_of(block: int) -> Iterator[tuple[int, RandomModel]]:
    """Yield the networks of a block that plain Python explores in a second or two."""
    for seed in range(block, min(block + BLOCK, NETWORKS)):
        model = random_model(seed)
        network = read_model(model.text, 'random.xml')
        invariant = [Query('A[] not deadlock or deadlock', '', None)]
        size = check(network, invariant, reduction=False, limits=Limits(states=SMALL))
        if size.complete:
            yield seed, model


def test_few_networks_are_too_large_to_compare() -> None:
    blocks = range(0, min(NETWORKS, 125), BLOCK)
    assert sum(1 for block in blocks for _ in models_of(block)) >= 0.9 * min(NETWORKS, 125)


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_random_networks(block: int) -> None:
    for seed, model in models_of(block):
        fairness = Fairness.WEAK if seed % 2 else Fairness.NONE
        native = answers(model, EngineKind.NATIVE, fairness, reduction=False)
        slow = answers(model, EngineKind.REFERENCE, fairness, reduction=False)
        assert summary(native) == summary(slow), f'seed {seed}'
        assert shortest(native) == shortest(slow), f'seed {seed}'
        counts = (native.states, native.transitions, native.complete)
        assert counts == (slow.states, slow.transitions, slow.complete), f'seed {seed}'
        assert counts[:2] == plain_counts(model), f'seed {seed}'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_reductions_keep_every_verdict(block: int) -> None:
    for seed, model in models_of(block):
        fairness = Fairness.WEAK if seed % 2 else Fairness.NONE
        reduced = answers(model, EngineKind.NATIVE, fairness, reduction=True)
        full = answers(model, EngineKind.REFERENCE, fairness, reduction=False)
        assert summary(reduced) == summary(full), f'seed {seed}'
