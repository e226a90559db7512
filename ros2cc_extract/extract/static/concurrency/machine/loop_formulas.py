"""The tests of a loop on plain data as formulas, to tell which writes leave them as they are."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

from ros2cc_extract.light_dataclasses import dataclass

UNKNOWN = object()
"""The result of a part of a test that is open."""

_MOST_OPEN = 4


@dataclass(frozen=True, eq=False)
class Formula:
    """
    A part of a test, see ``values_that_stay.py``.

    :param kind: ``asked`` for data of ``name``, perhaps an ``item`` of it; ``constant``;
        ``compared`` by the function in ``value``; ``and``, ``or``, ``not``; ``open``.
    :param names: of the data that an open part reads.
    :param node: the expression, for a part that is asked or open.
    """

    kind: str
    parts: tuple[Formula, ...] = ()
    name: str = ''
    item: str | None = None
    value: Any = None
    names: frozenset[str] = frozenset()
    node: ast.expr | None = None

    @property
    def all_names(self) -> frozenset[str]:
        """Of the data that it asks for."""
        own = self.names | ({self.name} if self.name else frozenset())
        return own.union(*(part.all_names for part in self.parts))

    def asked_of(self, name: str) -> frozenset[str | None]:
        """The items of the data of that name that are asked for; ``None`` for all of it."""
        if self.kind == 'asked':
            return frozenset([self.item]) if self.name == name else frozenset()
        own: frozenset[str | None] = frozenset([None] if name in self.names else [])
        return own.union(*(part.asked_of(name) for part in self.parts))

    def opens(self) -> Iterator[Formula]:
        """The parts that are open."""
        if self.kind == 'open':
            yield self
        for part in self.parts:
            yield from part.opens()

    def nodes(self) -> Iterator[ast.expr]:
        """The expressions of its parts, where they were kept."""
        if self.node is not None:
            yield self.node
        for part in self.parts:
            yield from part.nodes()

    def result(self, known: Mapping[tuple[str, str | None], object], opens: Opens) -> object:
        """What it gives with that data, and with such results of its open parts."""
        if self.kind == 'constant':
            return self.value
        if self.kind == 'asked':
            return known.get((self.name, self.item), UNKNOWN)
        if self.kind == 'open':
            return opens.get(id(self), UNKNOWN)
        results = [part.result(known, opens) for part in self.parts]
        if self.kind in ('and', 'or'):
            return _joined(results, decides=self.kind == 'or')
        if UNKNOWN in results:
            return UNKNOWN
        try:
            return not results[0] if self.kind == 'not' else self.value(*results)
        except TypeError:
            return UNKNOWN


Opens = Mapping[int, object]


def _joined(results: list[object], *, decides: bool) -> object:
    truths = [each if each is UNKNOWN else bool(each) for each in results]
    if decides in truths:
        return decides
    return UNKNOWN if UNKNOWN in truths else not decides


@dataclass(frozen=True)
class LoopTest:
    """A test of a loop, and how it comes out where that goes on; ``None`` where either way may."""

    formula: Formula
    stays_if: bool | None

    def stays(self, name: str, item: str | None, stored: object) -> bool:
        """
        Whether a loop that has gone on goes on when that is stored too.

        What the test asks beside may have any result by which the loop may have gone on.
        """
        opens = [part for part in self.formula.opens() if name not in part.names]
        if self.stays_if is None or len(opens) > _MOST_OPEN:
            return False
        for results in product((True, False), repeat=len(opens)):
            of_open = {id(part): result for part, result in zip(opens, results, strict=True)}
            before = self.formula.result({}, of_open)
            after = self.formula.result({(name, item): stored}, of_open)
            is_left_already = before is not UNKNOWN and bool(before) is not self.stays_if
            if not is_left_already and (after is UNKNOWN or bool(after) is not self.stays_if):
                return False
        return True

    def needed(self) -> tuple[LoopTest, ...]:
        """The tests all of which must come out otherwise for this one to do so."""
        if self.stays_if is None:
            return (self,)
        return tuple(_needed(self.formula, truth=not self.stays_if))


def _needed(formula: Formula, *, truth: bool) -> Iterator[LoopTest]:
    if formula.kind == 'not':
        yield from _needed(formula.parts[0], truth=not truth)
        return
    parts = formula.parts if formula.kind in ('and', 'or') else ()
    if parts and (formula.kind == 'or') is truth:
        # One of several is enough; what asks for no data is left out, as ``rclpy.ok()`` is.
        parts = tuple(part for part in parts if part.all_names)
        parts = parts if len(parts) == 1 else ()
    for part in parts:
        yield from _needed(part, truth=truth)
    if not parts:
        yield LoopTest(formula, stays_if=not truth)
