"""The house: which room may import which, no cycles, no room that outgrows its walls."""

from __future__ import annotations

import ast
import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[2]
PACKAGE = 'ros2cc_extract'
LEAVES = {
    'errors',
    'source_locations',
    'diagnostics',
    'version',
    'jobs',
    'cache_file',
    'files',
    'json_text',
    'plain_data',
    'text_escaping',
    'file_ownership',
    'identity_memo',
    'deadline',
    'light_dataclasses',
}
ALLOWED = {
    '__main__': {'*'},
    'ros': {'*'},
    'cli': {
        'confirm',
        'explore',
        'pipeline',
        'packages',
        'report',
        'findings',
        'verify',
        'generator',
        'checker',
        'conform',
        'spec',
        'compare',
        'extract',
        'extract.static',
        'extract.live',
        'hang_proof',
    },
    'hang_proof': {'extract.live', 'verify', 'generator', 'checker', 'spec'},
    'pipeline': {
        'extract.static.program',
        'findings',
        'verify',
        'generator',
        'checker',
        'spec',
        'revision',
        'extract',
        'extract.static',
        'extract.live',
        'extract.launch',
    },
    # Only here, and in what rests on it, is started what was scanned.
    'confirm': {'findings', 'verify', 'spec', 'extract', 'extract.live'},
    'explore': {'confirm', 'spec', 'extract.live', 'extract.static'},
    'packages': set(),
    'report': {'findings', 'verify', 'spec', 'compare'},
    'findings': {'verify', 'spec'},
    'verify': {'generator', 'checker', 'spec'},
    'generator': {'spec'},
    'checker': set(),
    'conform': {'generator', 'checker', 'spec'},
    'spec': set(),
    'revision': set(),
    'compare': {'spec', 'extract'},
    'extract': {'spec'},
    'extract.static': {'extract', 'extract.static.program', 'extract.static.scan'},
    # Each floor of the scanner knows those below it.
    'extract.static.program': {'extract'},
    'extract.static.python': {'extract.static.program', 'spec'},
    'extract.static.concurrency': {'extract.static.program', 'extract.static.python', 'spec'},
    'extract.static.libraries': {
        'extract.static.program',
        'extract.static.python',
        'extract.static.concurrency',
        'spec',
    },
    'extract.static.units': {
        'extract.static.program',
        'extract.static.python',
        'extract.static.concurrency',
        'extract.static.libraries',
        'extract',
        'spec',
    },
    'extract.static.packaging': {'extract.static.program', 'extract.static.python'},
    'extract.static.scan': {
        'extract.static.program',
        'extract.static.packaging',
        'extract.static.python',
        'extract.static.concurrency',
        'extract.static.libraries',
        'extract.static.units',
        'extract',
        'spec',
    },
    'extract.live': {'spec', 'extract'},
    # Launch files are Python that the interpreter follows, with a table of their own.
    'extract.launch': {
        'extract.static.program',
        'extract.static.packaging',
        'extract.static.python',
        'spec',
    },
    'live': {'extract.live'},
}
STATIC = f'{PACKAGE}.extract.static'
DOORS = {
    'program': ('',),
    'python': (
        'interpreter',
        'values.',
        'machine.',
        'objects.',
        'branching.',
        'builtins.builtin_',
    ),
    'concurrency': ('',),
    'libraries': ('model', 'standard.', 'rclpy.', 'qt.'),
    'units': ('units', 'entity_aliases', 'event_loops.', 'whole_program.'),
    'packaging': ('api', 'declarations'),
    'scan': ('scanning',),
}
"""How the modules begin that others may import of a room of the scanner."""
SPEC_OF_PYTHON = {'spec.effects', 'spec.model'}
"""The interpreter records effects, and when they happen, in the words of the specification."""
WORDS_OF_ROS = re.compile(
    r'rclpy|\bros|EntityKind|GroupType|(Entity|Node|Group|Executor)State', re.I
)
LONGEST_MODULE = 500
MOST_MODULES = 15
"""Of one folder; more are rooms that have not been separated yet."""
LONGEST_FUNCTION = 60


@cache
def modules() -> dict[str, Path]:
    """Dotted name to file, of everything that is installed."""
    found = {}
    for folder, prefix in (
        (ROOT / PACKAGE, PACKAGE),
        (ROOT / 'generator', f'{PACKAGE}.generator'),
    ):
        for path in sorted(folder.rglob('*.py')):
            parts = path.relative_to(folder).with_suffix('').parts
            if 'profiles' in parts or 'bootstrap' in parts:
                continue
            found['.'.join([prefix, *parts]).removesuffix('.__init__')] = path
    return found


def room(module: str) -> str:
    parts = module.split('.')[1:]
    if not parts:
        return ''
    if parts[:2] == ['extract', 'static'] and len(parts) + is_package(module) > 3:
        return '.'.join(parts[:3])
    if parts[:2] in (['extract', 'static'], ['extract', 'live'], ['extract', 'launch']):
        return '.'.join(parts[:2])
    return parts[0]


def imports(module: str, path: Path) -> Iterator[str]:
    """Also those that are there for types alone, and those inside functions."""
    for node in ast.walk(ast.parse(path.read_text(encoding='utf-8'))):
        if isinstance(node, ast.ImportFrom):
            # Only what also runs inside a user's process, under another name, is relative.
            package = '.'.join(module.split('.')[: -node.level]) if node.level else ''
            base = f'{package}.{node.module or ""}'.strip('.')
            yield base
            yield from (f'{base}.{alias.name}' for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


@cache
def edges() -> tuple[tuple[str, str], ...]:
    known = modules()
    return tuple(
        (module, imported)
        for module, path in known.items()
        for imported in imports(module, path)
        if imported in known and imported != module
    )


def test_rooms_import_only_what_the_design_allows() -> None:
    offences = [
        f'{module} imports {imported}'
        for module, imported in edges()
        if not is_allowed(room(module), room(imported))
    ]
    assert offences == []


def is_allowed(importer: str, imported: str) -> bool:
    if importer in ('', imported) or imported in LEAVES or imported == '':
        return True
    if importer in LEAVES:
        return False
    rooms = ALLOWED.get(importer, set())
    return '*' in rooms or imported in rooms


def test_rooms_of_the_scanner_are_entered_by_their_doors() -> None:
    offences = [
        f'{module} imports {imported}'
        for module, imported in edges()
        if imported.startswith(f'{STATIC}.')
        and room(module) != room(imported) != 'extract.static'
        and not is_package(imported)
        and not is_open(imported.removeprefix(f'{STATIC}.'))
    ]
    assert offences == []


def is_open(module: str) -> bool:
    where, _, rest = module.partition('.')
    return rest.startswith(DOORS[where])


def test_the_interpreter_knows_nothing_of_ros() -> None:
    """It may be used with another model of libraries, see ``unit/static/python``."""
    own = {m: path for m, path in modules().items() if m.startswith(f'{STATIC}.python')}
    found = [
        f'{module}: {word}'
        for module, path in own.items()
        for word in words(path)
        if WORDS_OF_ROS.search(word)
    ]
    found += [
        f'{module} imports {imported}'
        for module, imported in edges()
        if module in own
        and room(imported) == 'spec'
        and imported.removeprefix(f'{PACKAGE}.') not in SPEC_OF_PYTHON | {'spec'}
    ]
    assert found == []


def words(path: Path) -> Iterator[str]:
    """The names in a file and its texts, except those that say something to the reader."""
    tree = ast.parse(path.read_text(encoding='utf-8'))
    told = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            if id(node) not in told:
                yield node.value
        elif isinstance(node, ast.Name):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.ImportFrom):
            yield from (alias.name for alias in node.names)


def test_there_is_no_import_cycle() -> None:
    """Of no size: imports for types and those inside functions count too."""
    assert cycles(grouped(edges())) == []


def test_folders_stand_on_floors() -> None:
    """What a folder imports never leads back to it; what every room may import is apart."""
    between = [
        (folder(module), folder(imported))
        for module, imported in edges()
        if not is_package(imported)
    ]
    assert cycles(grouped((a, b) for a, b in between if '' not in (a, b) and a != b)) == []


def folder(module: str) -> str:
    """Where a module stands below the package; empty for what stands in no folder."""
    return module.removeprefix(f'{PACKAGE}.').rpartition('.')[0]


def is_package(module: str) -> bool:
    return modules()[module].name == '__init__.py'


def grouped(pairs: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    graph: dict[str, set[str]] = {}
    for one, other in pairs:
        graph.setdefault(one, set()).add(other)
    return graph


def test_folders_stay_small() -> None:
    sizes = Counter(path.parent for path in modules().values() if path.name != '__init__.py')
    too_many = {path.name: size for path, size in sizes.items() if size > MOST_MODULES}
    assert too_many == {}


def cycles(graph: dict[str, set[str]]) -> list[str]:
    found: list[str] = []
    finished: set[str] = set()

    def visit(module: str, path: tuple[str, ...]) -> None:
        if module in path:
            found.append(' -> '.join((*path[path.index(module) :], module)))
        elif module not in finished:
            for imported in sorted(graph.get(module, ())):
                visit(imported, (*path, module))
            finished.add(module)

    for module in sorted(graph):
        visit(module, ())
    return found


def test_cycle_finder_finds_a_cycle() -> None:
    assert cycles({'a': {'b'}, 'b': {'c'}, 'c': {'a'}}) == ['a -> b -> c -> a']


def test_modules_and_functions_stay_small() -> None:
    too_long = []
    for path in modules().values():
        text = path.read_text(encoding='utf-8')
        if len(text.splitlines()) > LONGEST_MODULE:
            too_long.append(f'{path.name}: {len(text.splitlines())} lines')
        too_long += [
            f'{path.name}:{node.lineno} {node.name}'
            for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            and length(node) > LONGEST_FUNCTION
        ]
    assert too_long == []


def length(node: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines of a function without its docstring."""
    lines = (node.end_lineno or node.lineno) - node.lineno + 1
    first = node.body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        lines -= (first.end_lineno or first.lineno) - first.lineno + 1
    return lines


def test_packages_have_empty_init_files() -> None:
    assert [p for p in modules().values() if p.name == '__init__.py' and p.read_text()] == []


def test_every_package_is_installed() -> None:
    settings = tomllib.loads((ROOT / 'pyproject.toml').read_text(encoding='utf-8'))
    installed = set(settings['tool']['setuptools']['packages'])
    folders = {
        '.'.join(path.parent.relative_to(ROOT).parts)
        for path in (ROOT / PACKAGE).rglob('__init__.py')
    }
    assert installed == folders | {f'{PACKAGE}.generator'}


def test_each_room_of_the_scanner_has_a_page() -> None:
    folder = ROOT / PACKAGE / 'extract' / 'static'
    assert [room for room in DOORS if not (folder / room / 'README.md').is_file()] == []
