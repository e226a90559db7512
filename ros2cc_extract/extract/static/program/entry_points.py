"""Where programs start: ``__main__`` guards, console scripts, ``main`` functions, scripts."""

from __future__ import annotations

import ast
import contextlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from ros2cc_extract.extract.static.program.source import SIZE_LIMIT_BYTES, SourceFile
from ros2cc_extract.extract.static.program.text_queries import walk
from ros2cc_extract.files import Files
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

_SCRIPT_FILES = ('setup.py', 'setup.cfg', 'pyproject.toml')
_SPINS = frozenset({'spin', 'spin_once', 'spin_until_future_complete'})


@dataclass(frozen=True)
class Entry:
    """
    A start of a program.

    :param function: module-level function to call; ``None`` to run the file as ``__main__``.
    :param label: as shown to the user, ``arm.py:main``.
    :param place: of a function that only spins: it is no start where another start calls it.
    """

    source: SourceFile
    function: str | None
    label: str
    place: Place | None = None


def entries_of(source: SourceFile, scripts: frozenset[tuple[str, str]]) -> list[Entry]:
    """The entries of one file, scripts first; none for a mere library."""
    tree = source.tree
    if tree is None:
        return []
    functions = {node.name: node for node in tree.body if isinstance(node, _FUNCTIONS)}
    callables = functions.keys() | _assigned_names(tree)
    found = [
        Entry(source, name, f'{source.shown}:{name}')
        for module, name in sorted(scripts)
        if module == source.module_name and name in callables
    ]
    if _is_script(tree):
        script = Entry(source, None, f'{source.shown}:{_script_label(tree)}')
        found = [entry for entry in found if entry.label != script.label]
        found.append(script)
    elif not found and 'main' in functions:
        found.append(Entry(source, 'main', f'{source.shown}:main'))
    elif not found:
        found.extend(
            Entry(source, name, f'{source.shown}:{name}', _place(source, node))
            for name, node in functions.items()
            if _spins(node) and not _wants_arguments(node)
        )
    return found


def _place(source: SourceFile, node: ast.stmt) -> Place:
    return Place(source.shown, node.lineno, node.col_offset + 1)


_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)


def _assigned_names(tree: ast.Module) -> set[str]:
    """What the module assigns, which may be functions that others made."""
    targets = (
        target for node in tree.body if isinstance(node, ast.Assign) for target in node.targets
    )
    return {target.id for target in targets if isinstance(target, ast.Name)}


def _wants_arguments(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    arguments = node.args
    given = len(arguments.posonlyargs) + len(arguments.args) - len(arguments.defaults)
    return given > 0 or None in arguments.kw_defaults


def _is_script(tree: ast.Module) -> bool:
    """Whether running the file does more than define names."""
    return any(_is_guard(node) or _runs(node) for node in tree.body)


def _is_guard(node: ast.stmt) -> bool:
    return isinstance(node, ast.If) and any(
        isinstance(part, ast.Name) and part.id == '__name__' for part in ast.walk(node.test)
    )


def _runs(node: ast.stmt) -> bool:
    if isinstance(node, (*_FUNCTIONS, ast.ClassDef, ast.Import, ast.ImportFrom)):
        return False
    if isinstance(node, ast.Expr) and (_only_call(node) == 'main' or _is_of_program(node.value)):
        return True
    return _spins(node)


_OF_PROGRAMS = frozenset({'asyncio.run', 'rclpy.init'})


def _is_of_program(value: ast.expr) -> bool:
    """Whether it is a call that only a program makes as it begins."""
    return isinstance(value, ast.Call) and ast.unparse(value.func) in _OF_PROGRAMS


def _script_label(tree: ast.Module) -> str:
    for node in tree.body:
        if _is_guard(node) and isinstance(node, ast.If) and len(node.body) == 1:
            called = _only_call(node.body[0])
            if called:
                return called
    return '__main__'


def _only_call(node: ast.stmt) -> str | None:
    value = getattr(node, 'value', None)
    if (
        isinstance(value, ast.Call)
        and len(value.args) == 1
        and isinstance(value.args[0], ast.Call)
    ):
        value = value.args[0]
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Name):
        return value.func.id
    return None


def _spins(node: ast.AST) -> bool:
    return any(isinstance(part, ast.Attribute) and part.attr in _SPINS for part in walk(node))


def script_files(files: Files, folders: Iterable[Path]) -> Iterator[tuple[Path, bytes]]:
    """The files that may declare scripts, as far as they can be read, in a fixed order."""
    for folder in sorted(folders):
        for path in (folder / name for name in _SCRIPT_FILES):
            if files.is_file(path):
                with contextlib.suppress(OSError):
                    yield path, files.read(path, SIZE_LIMIT_BYTES)
