"""A limit on time holds while a model and its queries are read, too."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from ros2cc_extract.checker.api import Limits, Query, Verdict
from ros2cc_extract.errors import InputError
from ros2cc_extract.verify.given_queries import verify_model
from ros2cc_extract.verify.search.options import Options
from tests.support.published import document
from tests.support.small import automaton

SMALL = document('bool b;', automaton('P', 'a c\na -> c; do: b = true'), 'system P;')
FEW = Options(limits=Limits(seconds=0.5))
LESS = Options(limits=Limits(seconds=0.01))


def test_a_query_of_many_parts_is_not_read_for_ever(tmp_path: Path) -> None:
    path = tmp_path / 'm.xml'
    path.write_text(SMALL, encoding='utf-8')
    formula = 'E<> ' + ' and '.join(['b'] * 100_000)
    started = time.process_time()
    with pytest.raises(InputError, match=r'the limit of 0\.5 s was reached before all was read'):
        verify_model(path, [Query(formula, '', None)], FEW)
    assert time.process_time() - started < 5


def test_a_model_of_many_locations_is_not_read_for_ever(tmp_path: Path) -> None:
    path = tmp_path / 'm.xml'
    places = ''.join(f'<location id="x{n}"/>' for n in range(200_000))
    path.write_text(SMALL.replace('<location', f'{places}<location', 1), encoding='utf-8')
    with pytest.raises(InputError, match='before all was read'):
        verify_model(path, [Query('A[] true', '', None)], LESS)


def test_a_small_model_is_checked_within_its_limit(tmp_path: Path) -> None:
    path = tmp_path / 'm.xml'
    path.write_text(SMALL, encoding='utf-8')
    options = Options(limits=Limits(seconds=60))
    (result,) = verify_model(path, [Query('E<> P.c', '', None)], options).results
    assert result.verdict is Verdict.SATISFIED
