"""Counts as people write them: ``1 file``, ``2 files``, ``3 not satisfied``."""

from __future__ import annotations


def counted(number: int, what: str) -> str:
    """Write one count of a summary, whose keys are plural and have underscores."""
    one = what[:-1] if number == 1 and what.endswith('s') else what
    return f'{number} {one.replace("_", " ")}'
