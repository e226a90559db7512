"""Several threads find what one finds: counts, verdicts, paths, limits and errors."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from ros2cc_extract.checker.api import (
    CheckResult,
    EngineKind,
    Fairness,
    Limits,
    Model,
    Query,
    check,
    read_model,
)
from ros2cc_extract.errors import ModelFormatError
from tests.support.networks import NETWORKS, random_model
from tests.support.published import one_group, published_model
from tests.support.small import single

native = pytest.importorskip(
    'ros2cc_extract.checker.engines.native', reason='the native core is not built'
)
pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

BLOCK = 25
SMALL = 3000


@pytest.fixture(autouse=True)
def threads_from_the_first_state(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native, 'JOBS_PAY_FROM', 1)


def networks(block: int) -> Iterator[tuple[int, Model, list[Query]]]:
    for seed in range(block, min(block + BLOCK, NETWORKS)):
        drawn = random_model(seed)
        model = read_model(drawn.text, 'random.xml')
        if check(model, (), reduction=False, limits=Limits(states=SMALL)).complete:
            yield seed, model, [Query(formula, '', None) for formula in drawn.formulas]


def told(result: CheckResult) -> tuple[object, ...]:
    """Give all of a result but its times."""
    answers = [
        (a.verdict, a.reason, a.path and (a.path.steps, a.path.cycle_start, a.path.ends))
        for a in result.answers
    ]
    return result.states, result.transitions, result.complete, answers


def asked(model: Model, queries: list[Query], jobs: int, **more: object) -> tuple[object, ...]:
    found = check(
        model,
        queries,
        engine=EngineKind.NATIVE,
        reduction=False,
        jobs=jobs,
        **more,  # type: ignore[arg-type]
    )
    return told(found)


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_random_networks(block: int) -> None:
    for seed, model, queries in networks(block):
        fairness = Fairness.WEAK if seed % 2 else Fairness.NONE
        alone = asked(model, queries, 1, fairness=fairness)
        for jobs in (2, 3):
            assert asked(model, queries, jobs, fairness=fairness) == alone, f'seed {seed}'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_search_that_ends_with_its_last_goal(block: int) -> None:
    for seed, model, queries in networks(block):
        reachability = [query for query in queries if query.formula[:3] in 'A[] E<>']
        for query in reachability:
            assert asked(model, [query], 2) == asked(model, [query], 1), f'seed {seed}, {query}'


@pytest.mark.parametrize('limit', [1, 7, 100, 1000, 2000, 3000])
def test_limit_on_states(limit: int) -> None:
    model = read_model(published_model(one_group(2, 2, 'REENTRANT')), 'published.xml')
    limits = Limits(states=limit)
    alone = asked(model, [*model.queries], 1, limits=limits)
    assert alone[0] == limit
    assert asked(model, [*model.queries], 3, limits=limits) == alone


def test_error_is_the_first_one() -> None:
    drawing = """a
    a -> a; do: n = n + 1
    a -> a; do: m = m + 1"""
    model = single(drawing, declaration='int[0, 60] n; int[0, 50] m;')
    messages = set()
    for jobs in (1, 2, 3):
        with pytest.raises(ModelFormatError) as caught:
            asked(model, [Query('A[] not deadlock', '', None)], jobs)
        messages.add(str(caught.value))
    assert len(messages) == 1


def test_goal_before_an_error_is_found_before_it() -> None:
    model = single('a\na -> a; do: n = n + 1', declaration='int[0, 60] n;')
    query = Query('E<> n == 59', '', None)
    assert asked(model, [query], 2) == asked(model, [query], 1)


def test_error_behind_the_last_goal_is_not_met() -> None:
    """A thread that knows of one goal only goes on; many tries, as threads take what they get."""
    drawing = """a
    a -> a; guard: n < 60; do: n++
    a -> a; guard: m < 60; do: m++
    a -> a; guard: n + m == 40 && n < 38; do: x = m"""
    model = single(drawing, declaration='int[0, 60] n, m; int[0, 1] x;')
    goals = [Query(f'E<> n + m == {level}', '', None) for level in (20, 40)]
    alone = asked(model, goals, 1)
    assert all(asked(model, goals, jobs) == alone for jobs in (2, 4) * 40)


def test_three_by_three_of_the_publication() -> None:
    model = read_model(published_model(one_group(3, 3, 'REENTRANT')), 'published.xml')
    queries = [*model.queries]
    found = asked(model, queries, 2)
    assert found[:3] == (343346, 695672, True)
    assert found == asked(model, queries, 1)
