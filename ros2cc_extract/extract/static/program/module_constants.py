"""Constants of a module, which are bound once in its file: ``SPEED = 5``."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterable, Iterator

from ros2cc_extract.extract.static.program.text_queries import walk

_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def module_constants(tree: ast.Module) -> frozenset[int]:
    """
    The uses of names that hold one value from the first line of the module on, by identity.

    A name that anything else in the file is called by as well, if only a parameter, is left out.
    """
    bound = Counter(name for part in walk(tree) for name in _bound_by(part))
    constants = {name for name in _bound_in_module(tree.body) if bound[name] == 1}
    return frozenset(
        id(part)
        for part in walk(tree)
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Load) and part.id in constants
    )


def _bound_in_module(statements: Iterable[ast.stmt]) -> Iterator[str]:
    for statement in statements:
        if isinstance(statement, (ast.Assign, ast.AnnAssign, ast.Import, ast.ImportFrom)):
            yield from (name for part in walk(statement) for name in _bound_by(part))


def _bound_by(part: ast.AST) -> Iterator[str]:
    """The names that a part of the tree gives a value, or may have others give one."""
    if isinstance(part, ast.Name) and not isinstance(part.ctx, ast.Load):
        yield part.id
    elif isinstance(part, ast.arg):
        yield part.arg
    elif isinstance(part, ast.alias):
        yield part.asname or part.name.partition('.')[0]
    elif isinstance(part, (ast.Global, ast.Nonlocal)):
        yield from part.names
    elif isinstance(part, (*_SCOPES, ast.ExceptHandler, ast.MatchAs, ast.MatchStar)):
        name = getattr(part, 'name', None)
        yield from (name,) if name else ()
    elif isinstance(part, ast.MatchMapping) and part.rest:
        yield part.rest
