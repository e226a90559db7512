"""Callers before what they call, read off the text: no function lacks a caller by mistake."""

from __future__ import annotations

import ast
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from heapq import heappop, heappush
from typing import TypeVar

from ros2cc_extract.extract.static.program.relevance import (
    creates_entities,
    may_wait,
    waits_for_others,
)
from ros2cc_extract.extract.static.program.text_queries import noted_on, walk

Item = TypeVar('Item')


def callers_first(
    items: Sequence[Item], names: Sequence[str], nodes: Sequence[ast.AST]
) -> list[Item]:
    """
    Bring ``items`` into an order in which one comes after those that mention its name.

    The given order decides where the text does not, and where items mention each other.
    """
    known = frozenset(names)
    said = [mentions(node) & known for node in nodes]
    wanting = Counter(name for each in said for name in each)
    named = defaultdict[str, list[int]](list)
    for number, name in enumerate(names):
        named[name].append(number)

    def is_free(number: int) -> bool:
        return wanting[names[number]] == (names[number] in said[number])

    free = list(filter(is_free, range(len(items))))
    waiting = dict.fromkeys(range(len(items)))
    ordered: list[Item] = []
    while waiting:
        first = heappop(free) if free else next(iter(waiting))
        if first not in waiting:
            continue
        del waiting[first]
        ordered.append(items[first])
        for name in said[first]:
            wanting[name] -= 1
            if wanting[name] < 2:
                for number in filter(waiting.__contains__, named[name]):
                    if is_free(number):
                        heappush(free, number)
    return ordered


def leading_to_entities(
    names: Sequence[str],
    nodes: Sequence[ast.AST],
    makers: frozenset[str],
    *,
    or_wait: Callable[[str], bool] | None = None,
) -> frozenset[str]:
    """
    Names of the methods that make or serve entities, themselves or through each other.

    :param makers: names of classes and functions that do so.
    :param or_wait: so do those that wait for others, and those it holds for that may wait.
    """
    methods = list(zip(names, nodes, strict=True))
    found = {
        name
        for name, node in methods
        if creates_entities(node)
        or not makers.isdisjoint(mentions(node))
        or (or_wait is not None and waits_for_others(node))
        or (or_wait is not None and may_wait(node) and or_wait(name))
    }
    users = defaultdict[str, list[str]](list)
    for name, node in methods:
        for mentioned in mentions(node):
            users[mentioned].append(name)
    left = list(found)
    while left:
        more = [user for user in users[left.pop()] if user not in found]
        found.update(more)
        left += more
    return frozenset(found)


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
