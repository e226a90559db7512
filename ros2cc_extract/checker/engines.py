"""Which engine searches; the only module that knows why one cannot be used."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from ros2cc_extract.checker.limits import Limits, Progress
from ros2cc_extract.checker.network import Network, Property
from ros2cc_extract.checker.search import Fairness, Reductions, SearchResult
from ros2cc_extract.errors import ToolNotFoundError

REFERENCE, NATIVE = 'reference', 'native'
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


def choose(wanted: str) -> Engine:
    """
    Return the engine for ``auto``, ``reference`` or ``native``.

    :raises ToolNotFoundError: the native core was asked for by name and is not built.
    """
    if wanted == REFERENCE:
        return _reference()
    try:
        importlib.import_module('ros2cc_extract.checker._core')
    except ImportError as error:
        if wanted == NATIVE:
            what = f'the native core of the checker is not built ({error})'
            raise ToolNotFoundError(what, None, _MEND) from None
        return _reference()
    from ros2cc_extract.checker import native

    return Engine(NATIVE, native.search)


def _reference() -> Engine:
    # Imported late, as the native engine is: each start needs one of the two.
    from ros2cc_extract.checker import reference

    return Engine(REFERENCE, reference.search)
