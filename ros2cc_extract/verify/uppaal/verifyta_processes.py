"""How often ``verifyta`` is started; apart from what starts it, which loads more slowly."""

from __future__ import annotations

from enum import Enum


class Runs(Enum):
    """Whether each query has a process of its own, which gives it a time and memory of its own."""

    TOGETHER = 'together'
    ONE_BY_ONE = 'one by one'
