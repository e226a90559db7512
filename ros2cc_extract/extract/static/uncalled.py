"""Functions that nobody in sight calls, and whose text would end a wait if somebody did."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from ros2cc_extract.extract.static.relevance import CHANGING_METHODS, noted_on, walk
from ros2cc_extract.extract.static.wakings import Word
from ros2cc_extract.extract.static.world import World
from ros2cc_extract.places import Place, Unknown

_METHODS: dict[str, Word] = {
    'set': Word.SET,
    'set_result': Word.SET,
    'set_exception': Word.SET,
    'notify': Word.SET,
    'notify_all': Word.SET,
    'put': Word.PUT,
    'put_nowait': Word.PUT,
    'get': Word.GET,
    'get_nowait': Word.GET,
    'task_done': Word.DONE,
    'release': Word.RELEASE,
    **dict.fromkeys(CHANGING_METHODS, Word.WRITE),
}

_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


@dataclass(frozen=True)
class _Operation:
    """One call ``….name.set()`` inside a function."""

    name: str
    word: Word
    line: int
    column: int
    function: int
    called: str
    is_attribute: bool = True


def uncalled_wakers(
    world: World, name: str, words: frozenset[Word], made_in: str
) -> Unknown | None:
    """
    Why somebody who is not in sight may end a wait for what is stored under ``name``.

    :param made_in: the file in which a variable of that name means it.
    """
    for tree, file in world.files:
        for operation in noted_on(tree, 'waking_operations', _operations):
            is_meant = operation.name == name and operation.word in words
            is_meant = is_meant and (operation.is_attribute or file == made_in)
            if is_meant and operation.function not in world.called:
                at = Place(file, operation.line, operation.column)
                return Unknown(f'nobody in sight calls {operation.called}, which ends it', at)
    return None


def data_is_written_elsewhere(world: World, names: frozenset[str]) -> Unknown | None:
    """Why somebody who is not in sight may write the data of ``names`` (``Class.attribute``)."""
    for name in sorted(names):
        by, place = world.other_writes.get(name, (None, None))
        if by is not None:
            return Unknown(f'nobody in sight calls {by}, which writes it', place)
    found = (
        uncalled_wakers(world, name.rpartition('.')[2], frozenset({Word.WRITE}), '')
        for name in names
    )
    return next((why for why in found if why is not None), None)


def _operations(tree: ast.Module) -> tuple[_Operation, ...]:
    return tuple(
        operation
        for part in walk(tree)
        if isinstance(part, _FUNCTIONS)
        for operation in _of_function(part)
    )


def _of_function(
    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda,
) -> Iterator[_Operation]:
    called = 'a lambda' if isinstance(node, ast.Lambda) else node.name
    for part in _own_parts(node):
        written = _written(part)
        if written is not None:
            at = (written.lineno, written.col_offset + 1)
            yield _Operation(written.attr, Word.WRITE, *at, id(node), called)
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Load):
            continue
        # Called there, or handed on to somebody who calls it.
        word, owner = _METHODS.get(part.attr), part.value
        name = owner.attr if isinstance(owner, ast.Attribute) else getattr(owner, 'id', None)
        if word is not None and name is not None:
            at, is_attribute = (part.lineno, part.col_offset + 1), isinstance(owner, ast.Attribute)
            yield _Operation(name, word, *at, id(node), called, is_attribute)


def _written(part: ast.AST) -> ast.Attribute | None:
    """The attribute that gets a new value or a new item."""
    if isinstance(part, ast.Subscript) and not isinstance(part.ctx, ast.Load):
        return part.value if isinstance(part.value, ast.Attribute) else None
    is_stored = isinstance(part, ast.Attribute) and not isinstance(part.ctx, ast.Load)
    return part if is_stored and isinstance(part, ast.Attribute) else None


def _own_parts(node: ast.AST) -> Iterator[ast.AST]:
    """What stands in a function, and in none inside of it."""
    waiting = list(ast.iter_child_nodes(node))
    while waiting:
        part = waiting.pop()
        if not isinstance(part, _FUNCTIONS):
            yield part
            waiting.extend(ast.iter_child_nodes(part))
