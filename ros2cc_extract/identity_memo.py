"""
What many ask of a value that never changes: found once for each.

Comparing or hashing a large value is slow: here identity counts, and what is known of
one is forgotten with it.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, TypeVar
from weakref import ref

Value = TypeVar('Value')
Fact = TypeVar('Fact')
_KNOWN: dict[int, tuple[ref[Any], dict[object, Any]]] = {}


def known_of(value: object) -> dict[object, Any]:
    """What is known of ``value``, as long as it lives; to be read and added to."""
    key = id(value)
    known = _KNOWN.get(key)
    if known is None or known[0]() is not value:
        known = ref(value, lambda _: _KNOWN.pop(key, None)), {}
        _KNOWN[key] = known
    return known[1]


def once(find: Callable[[Value], Fact]) -> Callable[[Value], Fact]:
    """Find a fact of a value only once; the fact must not be changed."""

    @wraps(find)
    def of(value: Value) -> Fact:
        known = known_of(value)
        if find not in known:
            known[find] = find(value)
        fact: Fact = known[find]
        return fact

    return of
