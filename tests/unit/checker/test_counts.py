"""State and transition counts of the published model, and its published verdicts."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import CheckResult, EngineKind, check, read_model
from tests.support.published import one_group, published_model


def explored(callbacks: int, threads: int, group: str) -> CheckResult:
    model = read_model(published_model(one_group(callbacks, threads, group)), 'published.xml')
    return check(model, model.queries, engine=EngineKind.REFERENCE, reduction=False)


def pattern(result: CheckResult) -> str:
    return ''.join(answer.verdict.value[0] for answer in result.answers)


@pytest.mark.parametrize(
    ('callbacks', 'threads', 'group', 'counts'),
    [
        (1, 1, 'EXCLUSIVE', (57, 85)),
        (1, 1, 'REENTRANT', (57, 85)),
        (2, 2, 'EXCLUSIVE', (2498, 4416)),
        (2, 2, 'REENTRANT', (3454, 6253)),
        (3, 3, 'EXCLUSIVE', (31262, 64020)),
        (4, 1, 'REENTRANT', (25978, 66004)),
    ],
)
def test_counts_equal_the_published_table(
    callbacks: int, threads: int, group: str, counts: tuple[int, int]
) -> None:
    result = explored(callbacks, threads, group)
    assert (result.states, result.transitions, result.complete) == (*counts, True)


def test_reentrant_three_by_three_counts() -> None:
    result = explored(3, 3, 'REENTRANT')
    assert (result.states, result.transitions) == (343346, 695672)
    assert pattern(result) == 's' + 'sss' + 'nnn' + 'nnn' + 'sss' + 's' + 'nns'


def test_published_verdicts_of_case_1() -> None:
    result = explored(4, 1, 'EXCLUSIVE')
    assert (result.states, result.transitions) == (25978, 66004)
    assert pattern(result) == 's' + 'ssss' + 'ssssss' + 'ssss' + 'nnnnnn' + 'n' + 'nnss'


def test_published_verdicts_of_case_2() -> None:
    result = explored(4, 4, 'EXCLUSIVE')
    assert (result.states, result.transitions) == (300162, 695130)
    assert pattern(result) == 's' + 'ssss' + 'ssssss' + 'ssss' + 'nnnnnn' + 'n' + 'nnnn'
