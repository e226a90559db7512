"""
Unknown code that may end a wait: functions without a caller, unknown objects.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from ros2cc_extract.extract.static.concurrency.accesses.holders import closure_cells
from ros2cc_extract.extract.static.concurrency.machine.state import ConcurrentWorld
from ros2cc_extract.extract.static.program.text_queries import CHANGING_METHODS, noted_on, walk
from ros2cc_extract.extract.static.python.machine.path_facts import Word
from ros2cc_extract.extract.static.python.values.containers import Collection
from ros2cc_extract.extract.static.python.values.values import Instance, Value, options_of
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown

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

FINDS_BY_TEXT = frozenset(['getattr', 'eval', 'exec', 'methodcaller', 'attrgetter'])
"""They find a function by a text."""
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


@dataclass(frozen=True)
class _Operation:
    """
    One call ``….name.set()`` inside a function.

    :param outer: the function or method it stands in, if nobody but the program may call that by
        its name: it is of no class with bases, and has no decorator.
    :param made_at: the lines that make what a variable of that name holds there; ``None`` where
        it may come from elsewhere.
    """

    name: str
    word: Word
    line: int
    column: int
    function: int
    called: str
    outer: str = ''
    outermost: int = 0
    is_attribute: bool = True
    made_at: tuple[int, ...] | None = None

    def may_mean(self, made: Place | None, file: str) -> bool:
        """Whether the variable in ``file`` may hold what was made at ``made``."""
        if self.is_attribute:
            return True
        is_there = made is not None and made.file == file
        return is_there and (self.made_at is None or made.line in self.made_at)  # type: ignore[union-attr]


def uncalled_wakers(
    world: ConcurrentWorld, name: str, words: frozenset[Word], made: Place | None
) -> Unknown | None:
    """
    Why unknown code may end a wait for what is stored under ``name``.

    :param made: where it is made; a variable of that name means it in the same file.
    """
    lost = next((at for word in words for at in _lost(world, name, word)), None)
    if lost is not None:
        return Unknown('it may be that of an object that could not be followed', lost)
    for tree, file in world.files:
        for operation in noted_on(tree, 'waking_operations', _operations):
            is_meant = operation.name == name and operation.word in words
            is_meant = is_meant and operation.may_mean(made, file)
            is_called = operation.function in world.called
            if is_meant and not is_called and not _is_dead(world, operation.outer):
                at = Place(file, operation.line, operation.column)
                return Unknown(f'no known code calls {operation.called}, which ends it', at)
    return None


def _is_dead(world: ConcurrentWorld, function: str) -> bool:
    """Whether the whole program is known and no text of it has the name of the function."""
    if not function or not world.is_program:
        return False
    texts = [noted_on(tree, 'mentioned', _mentioned) for tree, _ in world.files]
    return not any(function in text or not FINDS_BY_TEXT.isdisjoint(text) for text in texts)


def may_be_called(world: ConcurrentWorld, method: str) -> bool:
    """Whether Python, or a text of the program, may call a method of that name."""
    return method.startswith('__') or not _is_dead(world, method)


def is_handed_on(world: ConcurrentWorld, function: str) -> bool:
    """Whether a text of the program has the function as a value that it does not call."""
    return any(function in noted_on(tree, 'handed_on', _handed_on) for tree, _ in world.files)


def _handed_on(tree: ast.Module) -> frozenset[str]:
    called = {id(part.func) for part in walk(tree) if isinstance(part, ast.Call)}
    parts = (part for part in walk(tree) if id(part) not in called)
    return frozenset(
        part.attr if isinstance(part, ast.Attribute) else part.id
        for part in parts
        if isinstance(part, (ast.Attribute, ast.Name)) and isinstance(part.ctx, ast.Load)
    )


def _mentioned(tree: ast.Module) -> frozenset[str]:
    """What is called, handed on or spelled in a file."""
    names = {part.id for part in walk(tree) if isinstance(part, ast.Name)}
    names |= {part.attr for part in walk(tree) if isinstance(part, ast.Attribute)}
    texts = (part.value for part in walk(tree) if isinstance(part, ast.Constant))
    imported = (part.name for part in walk(tree) if isinstance(part, ast.alias))
    matched = (
        name for part in walk(tree) if isinstance(part, ast.MatchClass) for name in part.kwd_attrs
    )
    spelled = (text for text in texts if isinstance(text, str))
    return frozenset([*names, *spelled, *imported, *matched])


def _lost(world: ConcurrentWorld, name: str, word: Word) -> list[Place]:
    """Where a wait for that name may be ended, on an object that was never known."""
    places = world.lost_wakes.get((name, word), ())
    known = {waking.place for each in world.wakings.values() for waking in each} if places else ()
    return [place for place in places if place not in known]


def waking_of(call: ast.expr | str | None) -> tuple[str, Word] | None:
    """What ``….name.set()`` does, by the name of the attribute; ``None`` for other calls."""
    function = call.func if isinstance(call, ast.Call) else None
    if not isinstance(function, ast.Attribute) or not isinstance(function.value, ast.Attribute):
        return None
    word = _METHODS.get(function.attr, Word.WRITE)
    return (function.value.attr, word) if word is not Word.WRITE else None


def data_is_written_elsewhere(world: ConcurrentWorld, names: frozenset[str]) -> Unknown | None:
    """Why unknown code may write the data of ``names`` (``Class.attribute``)."""
    for name in sorted(names):
        by, place = world.other_writes.get(name, (None, None))
        if by is not None:
            return Unknown(f'no known code calls {by}, which writes it', place)
    found = (
        uncalled_wakers(world, name.rpartition('.')[2], frozenset({Word.WRITE}), None)
        for name in names
    )
    known = next((why for why in found if why is not None), None)
    return known or closure_cells.why_written_elsewhere(world, names)


def written_behind_constructors(world: ConcurrentWorld, name: str) -> bool:
    """Whether a function that is no constructor writes an attribute of that name, or its items."""
    attribute = name.rpartition('.')[2]
    noted = (noted_on(tree, 'waking_operations', _operations) for tree, _ in world.files)
    return any(
        each.name == attribute and each.word is Word.WRITE and each.called != '__init__'
        for operations in noted
        for each in operations
    )


def is_handed_over(
    world: ConcurrentWorld, holders: frozenset[tuple[Instance, str]]
) -> Unknown | None:
    """Why code that is not followed may change a collection that attributes hold."""
    held = (owner.slots.get(name) for owner, name in holders)
    options = [option for each in held if isinstance(each, Value) for option in options_of(each)]
    found = (world.handed_over.get(each) for each in options if isinstance(each, Collection))
    return next((why for why in found if why is not None), None)


def _operations(tree: ast.Module) -> tuple[_Operation, ...]:
    based = {
        id(part)
        for cls in walk(tree)
        if isinstance(cls, ast.ClassDef) and (cls.bases or cls.keywords or cls.decorator_list)
        for part in cls.body
    }
    return tuple(
        replace(operation, outer=operation.outer if operation.outermost not in based else '')
        for operation in _of_functions(tree, ())
    )


def _of_functions(node: ast.AST, scopes: tuple[_Function, ...]) -> Iterator[_Operation]:
    """Those of the functions inside of ``node``, which is itself the innermost of ``scopes``."""
    waiting = list(ast.iter_child_nodes(node))
    while waiting:
        part = waiting.pop()
        if isinstance(part, _FUNCTIONS):
            yield from _of_function(part, (part, *scopes))
        else:
            waiting.extend(ast.iter_child_nodes(part))


def _of_function(node: _Function, scopes: tuple[_Function, ...]) -> Iterator[_Operation]:
    yield from _of_functions(node, scopes)
    called = 'a lambda' if isinstance(node, ast.Lambda) else node.name
    outer = (_name_alone(scopes[-1]), id(scopes[-1]))
    for part in _own_parts(node):
        written = _written(part)
        if written is not None:
            at = (written.lineno, written.col_offset + 1)
            yield _Operation(written.attr, Word.WRITE, *at, id(node), called, *outer)
        if not isinstance(part, ast.Attribute) or not isinstance(part.ctx, ast.Load):
            continue
        # Called there, or handed on to code that calls it.
        word, owner = _METHODS.get(part.attr), part.value
        name = owner.attr if isinstance(owner, ast.Attribute) else getattr(owner, 'id', None)
        if word is not None and name is not None:
            at, is_attribute = (part.lineno, part.col_offset + 1), isinstance(owner, ast.Attribute)
            made_at = None if is_attribute else _made_at(name, scopes)
            yield _Operation(name, word, *at, id(node), called, *outer, is_attribute, made_at)


def _name_alone(function: _Function) -> str:
    """The name by which alone a function is called; empty where there may be other ways."""
    if isinstance(function, ast.Lambda) or function.decorator_list:
        return ''
    return '' if function.name.startswith('__') else function.name


def _made_at(name: str, scopes: tuple[_Function, ...]) -> tuple[int, ...] | None:
    """Where the function that owns the variable makes what it holds, if it does so itself."""
    for scope in scopes:
        arguments = scope.args
        known = (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
        if any(
            argument.arg == name
            for argument in (*known, arguments.vararg, arguments.kwarg)
            if argument
        ):
            return None
        stored = [part for part in _own_parts(scope) if _is_stored(part, name)]
        if stored:
            made = [part for part in _own_parts(scope) if _makes(part, name)]
            return tuple(part.value.lineno for part in made) if len(made) == len(stored) else None  # type: ignore[attr-defined]
    return None


def _is_stored(part: ast.AST, name: str) -> bool:
    """Whether the name gets a value here, or one from elsewhere."""
    if isinstance(part, (ast.Global, ast.Nonlocal)):
        return name in part.names
    return isinstance(part, ast.Name) and part.id == name and not isinstance(part.ctx, ast.Load)


def _makes(part: ast.AST, name: str) -> bool:
    """``name = Future()``: a new object of a class."""
    if not isinstance(part, ast.Assign) or not isinstance(part.value, ast.Call):
        return False
    function = part.value.func
    called = function.attr if isinstance(function, ast.Attribute) else getattr(function, 'id', '')
    is_plain = [getattr(target, 'id', None) for target in part.targets] == [name]
    return is_plain and called[:1].isupper()


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
