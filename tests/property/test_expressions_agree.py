"""
Random expressions have the values that C gives them, in what way they may be worked out.

The values come from an evaluator that shares nothing with the checker, not even the order of the
operators. UPPAAL documentation, page "Expressions".
"""

from __future__ import annotations

import pytest

from ros2cc_extract.checker.api import EngineKind
from ros2cc_extract.errors import ModelFormatError
from tests.support.expressions import DECLARATION, Drawing, Drawn, value_of
from tests.support.small import holds, single

SEEDS = range(150)


def found(drawn: Drawn, value: int | None, engine: EngineKind) -> str:
    """Return what comes of storing the expression."""
    drawing = f'a b\na -> b; do: result = ({drawn.text})'
    try:
        model = single(drawing, DECLARATION)
        answers = holds(
            model,
            'E<> P.b',
            f'A[] P.b imply result == {value or 0}',
            f'A[] P.a imply ({drawn.text}) == {value or 0}',
            engine=engine,
        )
    except ModelFormatError:
        return 'invalid'
    return 'right' if all(answers) else 'wrong'


@pytest.mark.parametrize('seed', SEEDS)
def test_expression_has_the_value_of_c(seed: int) -> None:
    drawn = Drawing(seed).expression(4)
    value = value_of(drawn.lazy)
    # What is never evaluated may be refused beforehand where it can only be invalid.
    may_be_refused = value_of(drawn.eager) is None
    for engine in (EngineKind.REFERENCE, EngineKind.AUTO):
        outcome = found(drawn, value, engine)
        if outcome == 'invalid':
            assert may_be_refused, drawn.text
        else:
            assert (outcome, value is None) == ('right', False), drawn.text
