"""Programs that run side by side in forks, see ``forked.py``, and how long each may take."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

#: For what must come: however slow the machine, it comes.
PATIENCE_S = 120.0


@dataclass(frozen=True, kw_only=True)
class Program:
    """
    What is run, and what it is killed by.

    :param awaited: patterns of whole lines; when all have come in this order, it is over.
    :param patience_s: seconds after it has said ``asks`` when it is over in any case.
    :param afterwards_s: how much longer it runs when all has come.
    """

    name: str
    path: str
    text: str
    patience_s: float
    awaited: tuple[str, ...] = ()
    afterwards_s: float = 0.0


RunForked = Callable[[Iterable[Program]], dict[str, list[str]]]
Built = tuple[str, RunForked]
"""A release, and what runs programs on it."""
