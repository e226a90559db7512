"""Committed chains that are run through and not stored keep verdicts and shortest paths."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Limits,
    Model,
    Query,
    Reductions,
    check,
    read_model,
)
from ros2cc_extract.checker.engines.search import NO_REDUCTIONS, Symmetry
from tests.support.crowds import random_crowd
from tests.support.networks import NETWORKS, RandomModel, random_model

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

BLOCK = 25
SMALL = 1500
CHAINS_ALONE = Reductions(dead=False, symmetry=Symmetry.NEVER, chains=True)
ALL = Reductions(symmetry=Symmetry.ALWAYS)
ALL_BUT_CHAINS = Reductions(symmetry=Symmetry.ALWAYS, chains=False)


def draw(seed: int) -> RandomModel:
    """Two in three have more committed locations than were drawn, one in three many processes."""
    if seed % 3 == 2:
        return random_crowd(seed)
    drawn = random_model(seed)
    text = drawn.text.replace('<urgent/>', '<committed/>') if seed % 3 else drawn.text
    return RandomModel(text, drawn.formulas)


def networks(block: int) -> Iterator[tuple[int, Model, list[Query]]]:
    """Yield those of a block that plain Python explores in a second, with reachability queries."""
    for seed in range(block, min(block + BLOCK, NETWORKS)):
        drawn = draw(seed)
        model = read_model(drawn.text, 'random.xml')
        if check(model, (), reduction=False, limits=Limits(states=SMALL)).complete:
            yield seed, model, [Query(f, '', None) for f in drawn.formulas if f[:3] in 'A[] E<>']


def told(result: CheckResult) -> list[tuple[str, int | None]]:
    """Give verdicts, and the number of steps of each path, which was replayed."""
    return [
        (a.verdict.value, None if a.path is None else len(a.path.steps)) for a in result.answers
    ]


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_chains_keep_verdicts_and_shortest_paths(block: int) -> None:
    for seed, model, queries in networks(block):
        wanted = told(check(model, queries, engine=EngineKind.REFERENCE, reduction=False))
        for reductions in (CHAINS_ALONE, ALL_BUT_CHAINS, ALL):
            found = check(model, queries, engine=EngineKind.NATIVE, reduction=reductions)
            assert told(found) == wanted, f'seed {seed}, {reductions}'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_each_query_alone_gets_the_same_answer(block: int) -> None:
    for seed, model, queries in networks(block):
        together = told(check(model, queries, reduction=CHAINS_ALONE))
        alone = [told(check(model, [query], reduction=CHAINS_ALONE))[0] for query in queries]
        assert alone == together, f'seed {seed}'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_no_state_is_stored_that_a_full_search_does_not_store(block: int) -> None:
    for seed, model, _ in networks(block):
        full = check(model, (), reduction=NO_REDUCTIONS)
        assert full.complete
        assert check(model, (), reduction=CHAINS_ALONE).states <= full.states, f'seed {seed}'


def test_many_networks_get_smaller() -> None:
    counts = [
        [check(model, (), reduction=r).states for r in (NO_REDUCTIONS, CHAINS_ALONE)]
        for _, model, _ in networks(0)
    ]
    assert sum(chains < full for full, chains in counts) >= len(counts) / 3
