"""Which engine searches; the only module that knows why one cannot be used."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from typing import Protocol

from ros2cc_extract.checker.engines.limits import Limits, Progress
from ros2cc_extract.checker.engines.search import Reductions, SearchResult
from ros2cc_extract.checker.engines.terms import EngineKind, Fairness
from ros2cc_extract.checker.network.network import Network, Property
from ros2cc_extract.errors import ToolNotFoundError
from ros2cc_extract.light_dataclasses import dataclass

_MEND = 'install a C++ compiler and Python.h, then install this package again'


class Search(Protocol):
    """How every engine is called."""

    def __call__(
        self,
        network: Network,
        properties: Sequence[Property],
        *,
        limits: Limits,
        fairness: Fairness,
        reductions: Reductions,
        progress: Callable[[Progress], None] | None,
        jobs: int,
    ) -> SearchResult: ...


@dataclass(frozen=True)
class Engine:
    """An engine under its name."""

    name: str
    search: Search


def choose(wanted: EngineKind) -> Engine:
    """
    Return the engine that is asked for.

    :raises ToolNotFoundError: the native core was asked for by name and is not built.
    """
    if wanted is EngineKind.REFERENCE:
        return _reference()
    try:
        importlib.import_module('ros2cc_extract.checker._core')
    except ImportError as error:
        if wanted is EngineKind.NATIVE:
            what = f'the native core of the checker is not built ({error})'
            raise ToolNotFoundError(what, None, _MEND) from None
        return _reference()
    from ros2cc_extract.checker.engines.native import search

    return Engine(EngineKind.NATIVE.value, search)


def _reference() -> Engine:
    # Imported late, as the native engine is: each start needs one of the two.
    from ros2cc_extract.checker.engines.reference import search

    return Engine(EngineKind.REFERENCE.value, search)
