"""Names of callbacks, groups and nodes in a unit: readable, unique, the same on every run."""

from __future__ import annotations

import ast
import re
from collections.abc import Sequence
from dataclasses import dataclass

from ros2cc_extract.extract.static.values import (
    NONE,
    Bound,
    Choice,
    Class,
    Const,
    Function,
    Instance,
    Library,
    Mystery,
    Native,
    Partial,
    Value,
    options_of,
)
from ros2cc_extract.places import Place, Unknown
from ros2cc_extract.spec.identifiers import mend


@dataclass(frozen=True)
class FunctionFacts:
    """
    What a callback value says of itself.

    :param label: short name to build the callback's name from.
    """

    label: str
    function: str | None = None
    defined: Place | None = None
    coroutine: bool = False
    unresolved: Unknown | None = None


def describe(value: Value | None, place: Place) -> FunctionFacts:
    """The facts of a callback function."""
    if isinstance(value, Function):
        return _describe_function(value)
    if isinstance(value, Bound):
        return _describe_function(value.function)
    if isinstance(value, Partial):
        return describe(value.function, place)
    if isinstance(value, Instance) and isinstance(value.cls, Class):
        method = value.cls.slots.get('__call__')
        if isinstance(method, Function):
            facts = _describe_function(method)
            return FunctionFacts(value.class_name, facts.function, facts.defined, facts.coroutine)
    if isinstance(value, (Native, Library)):
        return FunctionFacts(value.name.rpartition('.')[2], value.name)
    if isinstance(value, Class):
        return FunctionFacts(value.name, f'{value.module.name}.{value.qualname}', value.place)
    return _describe_unknown(value, place)


def _describe_function(function: Function) -> FunctionFacts:
    wrapped = function.slots.get('__wrapped__')
    if isinstance(wrapped, (Function, Bound)):
        return describe(wrapped, function.place)
    label = function.name
    if isinstance(function.node, ast.Lambda):
        label = f'lambda_{called}' if (called := _called_name(function.node)) else 'lambda'
    return FunctionFacts(label, function.full_name, function.place, function.is_coroutine)


def _called_name(node: ast.Lambda) -> str:
    body = node.body
    for part in ast.walk(body):
        if isinstance(part, ast.Call):
            if isinstance(part.func, ast.Attribute):
                return part.func.attr
            if isinstance(part.func, ast.Name):
                return part.func.id
    return ''


def _describe_unknown(value: Value | None, place: Place) -> FunctionFacts:
    if value is None or value == NONE:
        return FunctionFacts('callback', None, None, False, Unknown('no callback is given', place))
    if isinstance(value, Choice):
        options = [describe(option, place) for option in options_of(value)]
        names = [facts.label for facts in options]
        reason = Unknown(f'one of {", ".join(names)}, depending on a branch', place)
        return FunctionFacts('_or_'.join(names[:3]), None, None, False, reason)
    if isinstance(value, Mystery):
        text = value.text or 'callback'
        label = re.split(r'[(\[]', text)[0].rpartition('.')[2]
        reason = Unknown(f'{text}: {value.unknown.reason}', value.unknown.at or place)
        return FunctionFacts(label or 'callback', None, None, False, reason)
    return FunctionFacts('callback', None, None, False, Unknown('not a function', place))


def snake_case(name: str) -> str:
    """``JointStatePublisher`` -> ``joint_state_publisher``."""
    return re.sub(r'(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])', '_', name).lower()


def constant_text(value: Value | None) -> str | None:
    """A string constant's text."""
    if isinstance(value, Const) and isinstance(value.value, str):
        return value.value
    return None


class Names:
    """The names of one unit; each is given once."""

    def __init__(self) -> None:
        self._taken: set[str] = set()
        self._next: dict[str, int] = {}

    def __contains__(self, name: str) -> bool:
        return name in self._taken

    def take(self, label: str) -> str:
        """A usable name from ``label``, numbered when that is taken."""
        name = base = mend(label)
        number = self._next.get(base, 2)
        while name in self._taken:
            name, number = f'{base}_{number}', number + 1
        self._next[base] = number
        self._taken.add(name)
        return name


@dataclass(frozen=True)
class Wanted:
    """A name somebody would like to have, and what tells him from others of that name."""

    label: str
    key: str | None
    node: str | None


def unique_names(wanted: Sequence[Wanted], taken: Names) -> list[str]:
    """Give each its label where that is free, else prefixed by key, node, or numbered."""
    members: dict[str, list[int]] = {}
    for index, entry in enumerate(wanted):
        members.setdefault(mend(entry.label), []).append(index)
    alone = {name for name, indices in members.items() if len(indices) == 1 and name not in taken}
    names = {indices[0]: taken.take(name) for name, indices in members.items() if name in alone}
    for name, indices in members.items():
        if name not in alone:
            candidates = _tell_apart(wanted, indices, taken)
            for index, candidate in zip(indices, candidates, strict=True):
                names[index] = taken.take(candidate)
    return [names[index] for index in range(len(wanted))]


def _tell_apart(wanted: Sequence[Wanted], members: list[int], taken: Names) -> list[str]:
    entries = [wanted[index] for index in members]
    for parts in (('key',), ('node',), ('node', 'key')):
        names = [_prefixed(entry, parts) for entry in entries]
        if len(parts) == 1 and None in names:
            continue
        mended = [mend(name or entry.label) for name, entry in zip(names, entries, strict=True)]
        if len(set(mended)) == len(mended) and not any(name in taken for name in mended):
            return mended
    return [_best_prefixed(entry, len(entries)) for entry in entries]


def _prefixed(entry: Wanted, parts: Sequence[str]) -> str | None:
    texts = [text for part in parts if (text := getattr(entry, part)) is not None]
    return '_'.join([*texts, entry.label]) if texts else None


def _best_prefixed(entry: Wanted, number: int) -> str:
    return _prefixed(entry, ('key',)) or entry.label if number > 1 else entry.label
