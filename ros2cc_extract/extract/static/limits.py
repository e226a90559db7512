"""Limits of the Python that runs us, raised while a program is followed."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager

_RECURSION = 8_000


@contextmanager
def scanning_limits() -> Iterator[None]:
    """
    Allow the depth that the machine's own limits need, and pause the cyclic collector.

    Syntax trees are large and live as long as the scan: looking for cycles among them again
    and again takes longer than the scan itself.
    """
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


def _age_everything() -> None:
    """
    Make all that is there old for the collector, without looking at it.

    Else it goes through all of it as soon as it may; a tenth of the time of a scan. It gets
    there in its own time (``gcmodule.c``: both only join lists).
    """
    if not gc.get_freeze_count():
        gc.freeze()
        gc.unfreeze()
