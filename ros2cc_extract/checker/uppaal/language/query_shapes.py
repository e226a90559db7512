"""
Queries that differ by their numbers alone are parsed once: a large unit asks 40,000.

Each number stands in the tree as it was written, so a tree with others in their places is what the
parser would have made.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

from ros2cc_extract.checker.uppaal.language import syntax

_NUMBER = re.compile(r'(?<![\w.])[0-9]+(?![\w.])')
# The first of the numbers that stand for others; no number that is written stays in a shape.
_FIRST = 1_000_000_000
#: Gives the tree with these numbers in their places.
Maker = Callable[[Sequence[int]], Any]


def shape_of(text: str) -> tuple[str, list[int]]:
    """Give the text with other numbers for its own, always the same ones, and its own."""
    # As the tree's builder reads them: what is longer is out of range anyway.
    numbers = [int(number[:20]) for number in _NUMBER.findall(text)]
    others = itertools.count(_FIRST)
    return _NUMBER.sub(lambda _: str(next(others)), text), numbers


def maker_of(tree: Any) -> Maker:
    """Give what makes the tree of a text out of that of its shape and its numbers."""
    return _maker(tree) or (lambda numbers: tree)


def _maker(node: Any) -> Maker | None:
    """Nothing where there is no number to put in."""
    if isinstance(node, syntax.Number) and node.value >= _FIRST:
        line, depth, place = node.line, node.depth, node.value - _FIRST
        return lambda numbers: syntax.Number(line, depth, numbers[place])
    if isinstance(node, tuple):
        return _made_of(node, lambda *parts: parts)
    if is_dataclass(node):
        return _made_of([getattr(node, each.name) for each in fields(node)], type(node))
    return None


def _made_of(parts: Sequence[Any], make: Callable[..., Any]) -> Maker | None:
    makers = [_maker(part) for part in parts]
    if not any(makers):
        return None
    each = list(zip(parts, makers, strict=True))
    return lambda numbers: make(*(maker(numbers) if maker else part for part, maker in each))
