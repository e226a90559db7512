"""Cheap questions about a piece of text, each answered once for a syntax tree."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TypeVar

RECURSION = 'recursion'
"""Marks a loop that is written as calls of a function by itself."""

CHANGING_METHODS = frozenset(
    {
        'append',
        'appendleft',
        'add',
        'clear',
        'discard',
        'extend',
        'extendleft',
        'insert',
        'pop',
        'popitem',
        'popleft',
        'remove',
        'reverse',
        'setdefault',
        'sort',
        'update',
        '__delitem__',
        '__setitem__',
    }
)
"""Methods of Python's collections that change their owner in place."""


def changed_globals(tree: ast.Module) -> frozenset[str]:
    """Names that the module declares global somewhere, or changes in place."""
    return frozenset(
        name
        for part in walk(tree)
        if part.__class__ in _CHANGING_NODES
        for name in _changed_names(part)
    )


Noted = TypeVar('Noted')
Node = TypeVar('Node', bound=ast.AST)


def noted_on(node: Node, key: str, find: Callable[[Node], Noted]) -> Noted:
    """What ``find`` says of ``node``, kept on the node itself, so that it goes with the tree."""
    notes = node.__dict__
    if key not in notes:
        notes[key] = find(node)
    known: Noted = notes[key]
    return known


class _Fields(dict[type[ast.AST], tuple[str, ...]]):
    """The fields of each class of node below which there is anything to look at."""

    _LEAVES = frozenset(
        {'ctx', 'op', 'ops', 'id', 'attr', 'arg', 'asname', 'module', 'level', 'kind', 'rest'}
        | {'type_comment', 'type_ignores', 'conversion', 'is_async', 'simple', 'kwd_attrs', 'tag'}
    )

    def __missing__(self, cls: type[ast.AST]) -> tuple[str, ...]:
        fields = tuple(
            name
            for name in cls._fields
            if name not in self._LEAVES and (name != 'name' or cls.__name__ == 'TypeAlias')
        )
        if issubclass(cls, (ast.Constant, ast.MatchSingleton, ast.Global, ast.Nonlocal)):
            fields = ()
        self[cls] = fields
        return fields


_FIELDS = _Fields()


def walk(node: ast.AST) -> Iterator[ast.AST]:
    """
    Every node below ``node``, in no particular order; some four times as fast as ``ast.walk``.

    Contexts and operators are left out: they are never asked for.
    """
    waiting = [node]
    fields = _FIELDS
    while waiting:
        part = waiting.pop()
        yield part
        for name in fields[part.__class__]:
            value = getattr(part, name, None)
            if value.__class__ is list:
                waiting += value if None not in value else [v for v in value if v is not None]
            elif value is not None:
                waiting.append(value)


_CHANGING_NODES = frozenset({ast.Global, ast.Subscript, ast.Attribute})


def _changed_names(part: ast.AST) -> list[str]:
    return part.names if isinstance(part, ast.Global) else changed_in_place(part)


def changed_in_place(part: ast.AST) -> list[str]:
    """The name whose object gets or loses an item here."""
    if isinstance(part, ast.Subscript) and isinstance(part.ctx, (ast.Store, ast.Del)):
        return [part.value.id] if isinstance(part.value, ast.Name) else []
    if isinstance(part, ast.Attribute) and part.attr in CHANGING_METHODS:
        return [part.value.id] if isinstance(part.value, ast.Name) else []
    return []


def mangled(name: str, cls: str | None) -> str:
    """The attribute that ``name`` means in the text of class ``cls``: private ones are its own."""
    if cls is None or not name.startswith('__') or name.endswith('__'):
        return name
    return f'_{cls.lstrip("_")}{name}'


def unmangled(name: str, cls: str) -> str:
    """How the text of class ``cls`` calls its attribute ``name``; only by a text, as ``'__x'``."""
    if name.startswith('__') and not name.endswith('__'):
        return repr(name)
    prefix = f'_{cls.lstrip("_")}'
    return name.removeprefix(prefix) if name.startswith(f'{prefix}__') else name


def assignments_of_attributes(cls: ast.ClassDef) -> dict[str, list[tuple[int, int]]]:
    """Where the text of a class stores anything but ``None``: line, column; see ``mangled``."""
    return noted_on(cls, 'assignments_of_attributes', _assignments_of_attributes)


def _assignments_of_attributes(cls: ast.ClassDef) -> dict[str, list[tuple[int, int]]]:
    parts = list(walk(cls))
    cleared = {
        id(target)
        for part in parts
        if isinstance(part, ast.Assign) and _is_none(part.value)
        for target in part.targets
    } | {id(p.target) for p in parts if isinstance(p, ast.AnnAssign) and _is_none(p.value)}
    found: dict[str, list[tuple[int, int]]] = {}
    for part in parts:
        if (
            isinstance(part, ast.Attribute)
            and part.ctx.__class__ is ast.Store
            and id(part) not in cleared
        ):
            place = (part.lineno, part.col_offset + 1)
            found.setdefault(mangled(part.attr, cls.name), []).append(place)
    return found


def _is_none(value: ast.expr | None) -> bool:
    return value is None or (isinstance(value, ast.Constant) and value.value is None)


_OF_SET_UP = ('__init__', '__set_name__')


def reassigned_attributes(cls: ast.ClassDef) -> Mapping[str, Sequence[ast.expr | None]]:
    """
    Attributes of ``self`` that a method assigns after the set-up of the object; see ``mangled``.

    With the text of each value, ``None`` for what is no plain assignment.
    """
    return noted_on(cls, 'reassigned_attributes', _reassigned_attributes)


def _reassigned_attributes(cls: ast.ClassDef) -> Mapping[str, Sequence[ast.expr | None]]:
    found: dict[str, list[ast.expr | None]] = {}
    for method in cls.body:
        is_function = isinstance(method, (ast.FunctionDef, ast.AsyncFunctionDef))
        if not is_function or method.name in _OF_SET_UP:  # type: ignore[attr-defined]
            continue
        values = {
            id(target): part.value
            for part in walk(method)
            if isinstance(part, (ast.Assign, ast.AnnAssign))
            for target in (part.targets if isinstance(part, ast.Assign) else [part.target])
        }
        for part in walk(method):
            if isinstance(part, ast.Attribute) and part.ctx.__class__ is ast.Store:
                name = mangled(part.attr, cls.name)
                found.setdefault(name, []).append(values.get(id(part)))
    return found


def replaced_attributes(cls: ast.ClassDef) -> frozenset[str]:
    """Those that more than the set-up assigns; what only the set-up calls is of it."""
    return noted_on(cls, 'replaced_attributes', _replaced_attributes)


def _replaced_attributes(cls: ast.ClassDef) -> frozenset[str]:
    texts = {
        method.name: list(walk(method))
        for method in cls.body
        if isinstance(method, (ast.FunctionDef, ast.AsyncFunctionDef))
    }
    return frozenset(
        mangled(part.attr, cls.name)
        for name in texts.keys() - _methods_of_set_up(texts)
        for part in texts[name]
        if isinstance(part, ast.Attribute) and part.ctx.__class__ is ast.Store
    )


def _methods_of_set_up(texts: Mapping[str, Sequence[ast.AST]]) -> set[str]:
    """The methods that the set-up of a class calls and no other method names."""
    called = {name: _called(parts) for name, parts in texts.items()}
    named = {
        name: {part.attr for part in parts if isinstance(part, ast.Attribute)}
        for name, parts in texts.items()
    }
    found = set(_OF_SET_UP)
    while True:
        by_set_up = {name for each in found for name in called.get(each, ())}
        by_others = {name for each in texts.keys() - found for name in named[each]}
        more = by_set_up & texts.keys() - by_others - found
        if not more:
            return found
        found |= more


def _called(parts: Sequence[ast.AST]) -> set[str]:
    functions = (part.func for part in parts if isinstance(part, ast.Call))
    return {each.attr for each in functions if isinstance(each, ast.Attribute)}


def is_test(name: str) -> bool:
    """Whether test runners take a function of this name for a test."""
    return name.startswith('test')


def is_recursion(loop: ast.While) -> bool:
    """True for a loop that stands for calls of a function by itself."""
    return isinstance(loop.test, ast.Constant) and loop.test.kind == RECURSION
