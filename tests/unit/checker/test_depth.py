"""Deep texts: what is allowed works on every engine, what is not is an error."""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind
from ros2cc_extract.errors import ModelFormatError
from tests.support.small import holds, single

ENGINES = [EngineKind.REFERENCE, EngineKind.AUTO]


@pytest.mark.parametrize('engine', ENGINES)
def test_deepest_expression_allowed(engine: EngineKind) -> None:
    model = single(f'a b\na -> b; guard: {"- " * 97}x < 0', 'int x = 1;')
    assert holds(model, 'E<> P.b', engine=engine) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_long_flat_conditions_are_not_deep(engine: EngineKind) -> None:
    guard = ' && '.join(['x == 1'] * 3000)
    model = single(f'a b\na -> b; guard: {guard}', 'int x = 1;')
    assert holds(model, 'E<> P.b', engine=engine) == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_states_may_be_longer_than_the_numbers_that_python_writes(engine: EngineKind) -> None:
    """14,400 bits are some 4,335 decimal digits, of which Python 3.11 writes 4,300."""
    declarations = f'int a[{14_400 // 16}]; int[-32768, 32767] last;'
    model = single(
        'a b\na -> b; guard: last == 0; do: last = -2\nb -> a; guard: last == -2', declarations
    )
    assert holds(model, 'E<> last == -2 && P.a', 'A[] a[7] == 0', engine=engine) == [True, True]


def test_brackets_do_not_count() -> None:
    model = single(f'a b\na -> b; guard: {"(" * 5000}x == 1{")" * 5000}', 'int x = 1;')
    assert holds(model, 'E<> P.b') == [True]


@pytest.mark.parametrize('engine', ENGINES)
def test_functions_in_functions_end_in_a_verdict_or_an_error(engine: EngineKind) -> None:
    functions = 'int f0(int n) { return n; }'
    for i in range(1, 40):
        functions += f'int f{i}(int n) {{ return {"- " * 90}f{i - 1}(n); }}'
    try:
        model = single('a b\na -> b; guard: f39(x) == 1', 'int x = 1;' + functions)
        assert holds(model, 'E<> P.b', engine=engine) == [True]
    except ModelFormatError as error:
        assert 'too deep' in str(error)
