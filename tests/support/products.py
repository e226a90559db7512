"""All pairs of two kinds of things: in the short suite each thing once, in the long one all."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def every_pair(firsts: Iterable[Any], seconds: Iterable[Any]) -> list[Any]:
    """
    Give the parameters of all pairs, most of them ``slow``.

    In continuous integration each of the longer side is seen once, in turn with each of the
    shorter one.
    """
    rows, columns = [*firsts], [*seconds]
    least = min(len(rows), len(columns))
    return [
        pytest.param(
            first, second, marks=() if row % least == column % least else pytest.mark.slow
        )
        for row, first in enumerate(rows)
        for column, second in enumerate(columns)
    ]
