"""What a unit of hundreds of callbacks asks ten thousand times: reported as if each were alone."""

from __future__ import annotations

from unittest import mock

import pytest

from ros2cc_extract.checker.api import Limits, Query, Verdict, check
from ros2cc_extract.checker.runs.complementary_queries import twins_of
from ros2cc_extract.checker.uppaal.elaboration.constant_calls import ConstantCalls
from ros2cc_extract.checker.uppaal.elaboration.elaborate import Elaboration
from ros2cc_extract.checker.uppaal.language.parsing import Start, parse, parse_query
from ros2cc_extract.errors import ModelFormatError
from ros2cc_extract.source_locations import Place
from tests.support.small import single

WALK = 'a b c\na -> b; do: x = 1\nb -> c; do: x = 2\n'
HERE = Place('query', 1)


def test_queries_that_deny_each_other_are_searched_for_once() -> None:
    model = single(WALK, 'int x;')
    formulas = ['A[] not (x == 1)', 'E<> (x == 1)', 'E<> (x == 5)', 'A[] not (x == 5)']
    queries = [Query(formula, '', None) for formula in formulas]
    alone = [check(model, [query]).answers[0] for query in queries]
    read = Elaboration.query
    with mock.patch.object(Elaboration, 'query', autospec=True, side_effect=read) as asked:
        told = check(model, queries).answers
    assert asked.call_count == 2
    assert [answer.query for answer in told] == queries
    assert [answer.verdict for answer in told] == [answer.verdict for answer in alone]
    assert [answer.path and len(answer.path.steps) for answer in told] == [
        answer.path and len(answer.path.steps) for answer in alone
    ]


def test_what_is_not_decided_is_denied_by_nobody() -> None:
    queries = [Query(f, '', None) for f in ('A[] not (x == 2)', 'E<> (x == 2)')]
    told = check(single(WALK, 'int x;'), queries, limits=Limits(states=1)).answers
    assert [answer.verdict for answer in told] == [Verdict.UNDECIDED] * 2
    assert told[0].reason == told[1].reason is not None


@pytest.mark.parametrize(
    ('formulas', 'twins'),
    [
        (['E<> (p)', 'A[] not (p)', 'A[] not (p)'], {1: 0, 2: 0}),
        (['A[] not (p) and (q)', 'E<> (p) and (q)'], {}),
        (['A[] not p', 'E<> p'], {}),
        (['A[] not (p)', 'E<> (q)'], {}),
        (['A[] not (p) /* ) */', 'E<> (p) /* ) */'], {}),
        (['A[] not (p', 'E<> (p'], {}),
    ],
)
def test_twins_are_those_of_the_same_bracket(formulas: list[str], twins: dict[int, int]) -> None:
    assert twins_of(formulas) == twins


@pytest.mark.parametrize(
    'text',
    [
        'A[] not (runs(1) and runs(22))',
        'E<> forall (i : int[0, 3]) a[i] == 4 || true',
        'A[] forall (i : scalar[4]) i != 2 + -7',
        'a.x3 > 3 --> b <= 10000000000',
        'A[] x == 1 /* 3 */ && y1 == 2',
        'E<> 99999999999999999999999999 == x',
        'E<> 1000000000 == x and x != 1',
        'A[] not deadlock',
    ],
)
def test_a_query_is_read_by_its_shape_as_it_stands(text: str) -> None:
    for _ in range(2):
        assert parse_query(text, HERE) == parse(text, Start.QUERY, HERE)


@pytest.mark.parametrize('text', ['E<> (x == 12', 'E<> 12 34', 'E<> 1.5 > x', 'A[] 7 ** 2 > 3'])
def test_a_query_that_is_wrong_is_told_as_it_stands(text: str) -> None:
    with pytest.raises(ModelFormatError) as by_shape:
        parse_query(text, HERE)
    with pytest.raises(ModelFormatError) as alone:
        parse(text, Start.QUERY, HERE)
    assert str(by_shape.value) == str(alone.value)


FUNCTIONS = """
const int N = 4;
const int table[N] = { 3, 1, 2, 2 };
typedef int[0, N - 1] Id;
int x;
int[0, 2] kind(Id c) { return table[c] <? 2; }
bool before(Id a, Id b) {
    if (kind(a) != kind(b))
        return kind(a) < kind(b);
    if (kind(a) == 1)
        return false;
    else
        return table[a] < table[b] || !(table[a] != table[b]) && a < b;
}
int reckoned(int a, int b) { return a > b ? a - b : a * b + N; }
bool truth(int a) { return a; }
int narrow(int[0, 2] a) { return table[a + 1] - x + x; }
"""
CALLS = [
    *(f'before({a}, {b})' for a in range(4) for b in range(4)),
    *(f'reckoned({a}, {b}) == {c}' for a, b, c in ((3, 1, 2), (1, 3, 7), (2, 2, 8))),
    *(f'truth({a}) == {int(bool(a))}' for a in (7, 0, 2)),
    *(f'narrow({a}) == 2' for a in (0, 1, 2)),
]


def test_calls_with_constants_have_the_values_that_elaboration_gives_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    model = single('a b\na -> b\n', FUNCTIONS)
    counted = [str(model.elaboration.query(f'E<> {call}', HERE)) for call in CALLS]
    monkeypatch.setattr(ConstantCalls, 'of_call', lambda *_: None)
    model = single('a b\na -> b\n', FUNCTIONS)
    assert counted == [str(model.elaboration.query(f'E<> {call}', HERE)) for call in CALLS]


def test_calls_with_constants_are_counted_out() -> None:
    counted = ConstantCalls.of_call
    with mock.patch.object(ConstantCalls, 'of_call', autospec=True, side_effect=counted) as of:
        model = single('a b\na -> b\n', FUNCTIONS)
        for call in CALLS:
            model.elaboration.query(f'E<> {call}', HERE)
    assert of.call_count > 12


@pytest.mark.parametrize('call', ['before(0, 4)', 'kind(4)', 'far(9)', 'beyond(2)'])
def test_what_leaves_its_range_is_told_as_elaboration_tells_it(
    call: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    more = (
        FUNCTIONS + 'int far(int a) { return a > 5 ? table[a] : a; }\n'
        'int[0, 3] beyond(int a) { return a * a; }\n'
    )

    def told() -> str:
        model = single('a b\na -> b\n', more)
        for first in ('before(0, 1)', 'kind(0)', 'far(1)', 'beyond(1)'):
            model.elaboration.query(f'E<> {first} == 1', HERE)
        try:
            query = Query(f'E<> {call} == 1', '', None)
            return str(check(model, [query]).answers[0].verdict)
        except ModelFormatError as error:
            return str(error)

    counted = told()
    monkeypatch.setattr(ConstantCalls, 'of_call', lambda *_: None)
    assert counted == told()
