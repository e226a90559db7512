"""
The order in which a test has failed, kept in the cache of pytest.

The number of a schedule alone gives the same order only where the same callbacks are ready in
time, which is the machine's to say. So the order itself is kept beside it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pytest

    from ros2cc_extract.explore.points import Point

Order = list[tuple[str, str]]
"""Who went on, and where it stood, choice by choice."""
_MOST = 2000


def keep(item: pytest.Item, number: int, points: Sequence[Point], order: Order) -> None:
    """Keep an order, unless pytest runs without its cache or it has too many choices."""
    cache = getattr(item.config, 'cache', None)
    if cache is not None and 0 < len(order) <= _MOST:
        row = {'schedule': number, 'points': _digest(points), 'order': order}
        cache.set(_key(item), row)


def kept(item: pytest.Item, number: int, points: Sequence[Point]) -> Order:
    """Give the order of a failed schedule; empty if none is kept, or the sources differ."""
    cache = getattr(item.config, 'cache', None)
    row: Any = cache.get(_key(item), None) if cache is not None else None
    if not isinstance(row, dict) or row.get('schedule') != number:
        return []
    order = row.get('order')
    if row.get('points') != _digest(points) or not isinstance(order, list):
        return []
    pairs = [each for each in order if isinstance(each, list) and len(each) == 2]
    return [(str(key), str(at)) for key, at in pairs]


def _key(item: pytest.Item) -> str:
    return f'ros2cc/failed_orders/{hashlib.sha256(item.nodeid.encode()).hexdigest()[:32]}'


def _digest(points: Sequence[Point]) -> str:
    return hashlib.sha256(repr(sorted(map(repr, points))).encode()).hexdigest()
