"""Limits of the Python that runs us, raised while a program is followed."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RECURSION = 8_000

_MUCH = 1_000_000
"""So many objects are worth a look for cycles; that takes some tenths of a second."""


class _Aged:
    """What scans have left behind since the last look for cycles among all of it."""

    objects = 0


@contextmanager
def scanning_limits() -> Iterator[None]:
    """
    Allow the depth that the machine's own limits need, and pause the cyclic collector.

    Syntax trees are large and live as long as the scan: looking for cycles among them again
    and again takes longer than the scan itself.
    """
    _forget_earlier_scans()
    before, collecting = sys.getrecursionlimit(), gc.isenabled()
    sys.setrecursionlimit(max(before, _RECURSION))
    gc.disable()
    try:
        yield
    finally:
        sys.setrecursionlimit(before)
        if collecting:
            _age_everything()
            gc.enable()


def forget_programs() -> None:
    """
    Free what the programs followed so far have left behind, once that is much.

    Each is full of cycles. What stays, as the trees do, is not looked at again.
    """
    if gc.get_count()[0] > _MUCH:
        gc.collect(0)


def _forget_earlier_scans() -> None:
    """Nothing else looks at what was made old, even if it is much."""
    if _Aged.objects > _MUCH:
        gc.collect()
        _Aged.objects = 0


def _age_everything() -> None:
    """
    Make all that is there old for the collector, without looking at it.

    Else it goes through all of it as soon as it may; a tenth of the time of a scan. It gets
    there in its own time (``gcmodule.c``: both only join lists).
    """
    if not gc.get_freeze_count():
        _Aged.objects += gc.get_count()[0]
        gc.freeze()
        gc.unfreeze()
