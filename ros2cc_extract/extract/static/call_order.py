"""Callers before what they call, read off the text: nobody is without a caller by mistake."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import TypeVar

from ros2cc_extract.extract.static.relevance import creates_entities, noted_on, walk

Item = TypeVar('Item')


def callers_first(
    items: Sequence[Item], names: Sequence[str], nodes: Sequence[ast.AST]
) -> list[Item]:
    """
    Bring ``items`` into an order in which one comes after those that mention its name.

    The given order decides where the text does not, and where items mention each other.
    """
    waiting = list(range(len(items)))
    ordered: list[Item] = []
    while waiting:
        first = next((i for i in waiting if not _wanted(i, waiting, names, nodes)), waiting[0])
        waiting.remove(first)
        ordered.append(items[first])
    return ordered


def _wanted(
    item: int, others: Sequence[int], names: Sequence[str], nodes: Sequence[ast.AST]
) -> bool:
    return any(names[item] in mentions(nodes[other]) for other in others if other != item)


def leading_to_entities(
    names: Sequence[str], nodes: Sequence[ast.AST], makers: frozenset[str]
) -> frozenset[str]:
    """
    Names of the methods that make or serve entities, themselves or through each other.

    :param makers: names of classes and functions that do so.
    """
    methods = list(zip(names, nodes, strict=True))
    found = {
        name
        for name, node in methods
        if creates_entities(node) or not makers.isdisjoint(mentions(node))
    }
    while True:
        more = {
            name
            for name, node in methods
            if name not in found and not found.isdisjoint(mentions(node))
        }
        if not more:
            return frozenset(found)
        found |= more


def mentions(node: ast.AST) -> frozenset[str]:
    """Every name below ``node`` that stands alone, or behind ``self.`` or ``cls.``."""
    return noted_on(node, 'mentions', _mentions)


def _mentions(node: ast.AST) -> frozenset[str]:
    return frozenset(name for part in walk(node) if (name := _name(part)))


def _name(part: ast.AST) -> str | None:
    if isinstance(part, ast.Name):
        return part.id
    if isinstance(part, ast.Attribute) and isinstance(part.value, ast.Name):
        return part.attr if part.value.id in ('self', 'cls') else None
    return None
