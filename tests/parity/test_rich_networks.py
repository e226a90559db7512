"""The engines agree on networks that use much of the language, also on which of them are wrong."""

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
    Reductions,
    check,
    read_model,
)
from ros2cc_extract.checker.engines.search import Symmetry
from ros2cc_extract.errors import ModelFormatError
from tests.support.networks import NETWORKS
from tests.support.rich_networks import rich_model

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

BLOCK = 25
SMALL = Limits(states=2000)
ALL = Reductions(symmetry=Symmetry.ALWAYS)
#: Keeps a search going until all states are known, and so until the first error.
EVERYWHERE = 'A[] deadlock or not deadlock'


def fairness_of(seed: int) -> Fairness:
    return Fairness.WEAK if seed % 2 else Fairness.NONE


def asked(
    model: Model,
    queries: list[Query],
    fairness: Fairness,
    engine: EngineKind,
    reduction: bool | Reductions = False,
    jobs: int = 1,
) -> CheckResult | str:
    """Return the answers, or the error in which the search ends."""
    try:
        return check(
            model, queries, engine=engine, fairness=fairness, reduction=reduction, jobs=jobs
        )
    except ModelFormatError as error:
        return str(error)


def told(answers: CheckResult | str) -> list[tuple[str, int | None]] | str:
    """Give verdicts and which have paths; of states to be reached also how long they are."""
    if isinstance(answers, str):
        return answers
    reaching = ('A[]', 'E<>')
    return [
        (
            answer.verdict.value,
            None
            if answer.path is None
            else len(answer.path.steps) * (answer.query.formula[:3] in reaching),
        )
        for answer in answers.answers
    ]


def networks(block: int) -> Iterator[tuple[int, Model, list[Query]]]:
    """Yield those of a block that plain Python explores in a second or two."""
    everywhere = [Query(EVERYWHERE, '', None)]
    for seed in range(block, min(block + BLOCK, NETWORKS)):
        drawn = rich_model(seed)
        model = read_model(drawn.text, 'random.xml')
        try:
            is_small = check(model, everywhere, reduction=False, limits=SMALL).complete
        except ModelFormatError:
            is_small = True
        if is_small:
            yield seed, model, [*everywhere, *(Query(f, '', None) for f in drawn.formulas)]


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_core_and_reference_agree_state_by_state(block: int) -> None:
    for seed, model, queries in networks(block):
        fairness = fairness_of(seed)
        slow = asked(model, queries, fairness, EngineKind.REFERENCE)
        for jobs in (1, 2):
            fast = asked(model, queries, fairness, EngineKind.NATIVE, jobs=jobs)
            assert told(fast) == told(slow), f'seed {seed}, {jobs} jobs'
            if isinstance(slow, CheckResult) and isinstance(fast, CheckResult):
                counts = [(result.states, result.transitions) for result in (fast, slow)]
                assert counts[0] == counts[1], f'seed {seed}, {jobs} jobs'


@pytest.mark.parametrize('block', range(0, NETWORKS, BLOCK))
def test_reductions_keep_verdicts_and_find_the_errors(block: int) -> None:
    for seed, model, queries in networks(block):
        reachability = [query for query in queries if query.formula[:3] in ('A[]', 'E<>')]
        for chosen in (queries, reachability):
            fairness = fairness_of(seed)
            full = asked(model, chosen, fairness, EngineKind.REFERENCE)
            reduced = asked(model, chosen, fairness, EngineKind.NATIVE, ALL)
            # Another order of states may meet another of several errors first.
            if isinstance(full, str) or isinstance(reduced, str):
                assert type(full) is type(reduced), f'seed {seed}'
            else:
                assert told(reduced) == told(full), f'seed {seed}'


def test_some_networks_break_a_range_and_most_do_not() -> None:
    ends = [
        isinstance(asked(model, queries[:1], Fairness.NONE, EngineKind.NATIVE), str)
        for block in range(0, min(NETWORKS, 125), BLOCK)
        for _, model, queries in networks(block)
    ]
    assert len(ends) >= 0.9 * min(NETWORKS, 125)
    assert 0 < sum(ends) < len(ends) / 4
