"""Liveness questions that are answered by several threads at once."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import CheckResult, EngineKind, Limits
from ros2cc_extract.errors import ModelFormatError
from tests.support.small import ask, single

pytest.importorskip('ros2cc_extract.checker._core', reason='the native core is not built')

# 131,072 states: enough for the core to start threads.
SWITCHES = 'a\n' + '\n'.join(f'a -> a; guard: !b[{k}]; do: b[{k}] = true' for k in range(17))
QUERIES = [f'b[{k}] --> b[{k + 1}]' for k in range(4)] + ['A<> b[0]', 'E[] not b[3]', 'A<> true']


def asked(*queries: str, **options: object) -> CheckResult:
    model = single(SWITCHES, 'bool b[17];')
    return ask(model, *queries, engine=EngineKind.NATIVE, reduction=False, **options)  # type: ignore[arg-type]


def told(result: CheckResult) -> list[tuple[str, int]]:
    return [(a.verdict.value, len(a.path.steps) if a.path else -1) for a in result.answers]


def test_all_at_once_say_what_each_says_alone() -> None:
    together = asked(*QUERIES)
    assert together.states == 131_072
    assert told(together) == [told(asked(query))[0] for query in QUERIES]
    assert told(together) == told(asked(*QUERIES))


def test_the_first_error_is_told_whichever_thread_meets_one_first() -> None:
    broken = ['b[0] --> 1 << (b[1] ? 40 : 1) > 9', 'b[0] --> 9 / (b[2] ? 0 : 1) > 9']
    for _ in range(3):
        with pytest.raises(ModelFormatError, match='shift by 40 bits'):
            asked(*broken)


def test_limit_of_time_ends_all_of_them() -> None:
    result = asked(*QUERIES, limits=Limits(seconds=0.0))
    assert {answer.verdict.value for answer in result.answers} == {'undecided'}
