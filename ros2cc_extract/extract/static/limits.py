"""Limits of the Python that runs us, raised while a program is followed."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RECURSION = 8_000


@contextmanager
def deep_recursion() -> Iterator[None]:
    """Allow the depth that the machine's own limits need, then put the old limit back."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(max(before, _RECURSION))
    try:
        yield
    finally:
        sys.setrecursionlimit(before)
