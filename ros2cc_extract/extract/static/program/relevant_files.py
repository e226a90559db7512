"""Which of the given files are worth following: those that name rclpy, and what imports them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.source import SourceFile

_IMPORT = re.compile(
    rb'^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]*(\([^)]*\)|[^\n#;]*)|import[ \t]+([^\n#;]+))',
    re.MULTILINE,
)
_TEST_FOLDERS = frozenset({'test', 'tests'})
_NAME = re.compile(r'[\w.]+')


def scanned_files(project: Project) -> list[SourceFile]:
    """
    The given files worth parsing for their own sake, in their order.

    A file that never names rclpy counts when it imports one that does, directly or through
    others: it may hold the subclasses, the callers or the start of what stands there. A test that
    never names rclpy puts something else in its place.
    """
    found = {source.shown for source in project.given if source.is_scanned}
    waiting = [s for s in project.given if s.shown not in found and not _is_test(s)]
    if not found or not waiting:
        return [source for source in project.given if source.shown in found]
    imports = {source.shown: list(_imported(source)) for source in waiting}
    while True:
        names = {_last(source) for source in project.given if source.shown in found}
        more = [
            source
            for source in waiting
            if any(
                _leads_there(project, source, name, names, found) for name in imports[source.shown]
            )
        ]
        if not more:
            return [source for source in project.given if source.shown in found]
        found.update(source.shown for source in more)
        waiting = [source for source in waiting if source.shown not in found]


def _is_test(source: SourceFile) -> bool:
    stem = source.path.stem
    return (
        stem == 'conftest'
        or stem.startswith('test_')
        or stem.endswith('_test')
        or not _TEST_FOLDERS.isdisjoint(source.shown.split('/'))
    )


def _last(source: SourceFile) -> str:
    return source.module_name.rpartition('.')[2]


def _leads_there(
    project: Project, source: SourceFile, name: str, names: set[str], found: set[str]
) -> bool:
    """Whether ``name`` is one of the files in ``found``; most are decided without the disk."""
    if name.rpartition('.')[2] not in names:
        return False
    module = project.module(name, source.shown)
    return module is not None and module.shown in found


def _imported(source: SourceFile) -> Iterator[str]:
    """Dotted names that may be modules which the text imports."""
    for module, names, plain in _IMPORT.findall(source.data):
        if plain:
            for name in plain.decode('ascii', 'replace').split(','):
                first = name.split()[:1]
                yield from first
            continue
        base = _absolute(module.decode(), source.package)
        yield base
        for name in _NAME.findall(names.decode('ascii', 'replace')):
            yield f'{base}.{name}' if base else name


def names_from_scanned(project: Project, source: SourceFile, tree: ast.Module) -> frozenset[str]:
    """Names that the top level of a file imports from scanned files."""
    found: set[str] = set()
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            module = _absolute('.' * node.level + (node.module or ''), source.package)
            if project.module(module, source.shown) is not None:
                found.update(alias.asname or alias.name for alias in node.names)
    return frozenset(found)


def _absolute(name: str, package: str) -> str:
    """The module that ``from name import`` means in a module of ``package``."""
    level = len(name) - len(name.lstrip('.'))
    if not level:
        return name
    parts = package.split('.') if package else []
    return '.'.join([*parts[: len(parts) - level + 1], *filter(None, [name[level:]])])
