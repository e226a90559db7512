"""Which engine searches; the only module that knows why one cannot be used."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from ros2cc_extract.checker import reference
from ros2cc_extract.checker.limits import Limits, Progress
from ros2cc_extract.checker.network import Network, Property
from ros2cc_extract.checker.search import Fairness, SearchResult


class Search(Protocol):
    """How every engine is called."""

    def __call__(
        self,
        network: Network,
        properties: Sequence[Property],
        *,
        limits: Limits,
        fairness: Fairness,
        reduction: bool,
        progress: Callable[[Progress], None] | None,
    ) -> SearchResult: ...


@dataclass(frozen=True)
class Engine:
    """An engine, and what the user should know about its choice."""

    name: str
    search: Search
    note: str = ''


def choose(wanted: str) -> Engine:
    """Return the engine for ``auto``, ``reference`` or ``native``."""
    return Engine(reference.NAME, reference.search)
