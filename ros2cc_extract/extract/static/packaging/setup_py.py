"""
Programs that a ``setup.py`` declares: followed by the abstract interpreter, never run.

Source: setuptools, "Entry Points" (a dictionary of lists or texts, or one text in the form of an
INI file), ``scripts``; ament_python (what ``data_files`` puts below ``lib/PACKAGE`` is a program).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from ros2cc_extract.extract.static.packaging.config_files import Found, of_group_texts, of_lines
from ros2cc_extract.extract.static.packaging.declarations import (
    GROUPS,
    Declarations,
    Program,
    declared,
    read_entry,
)
from ros2cc_extract.extract.static.program.project import Project
from ros2cc_extract.extract.static.program.runtime_limits import scanning_limits
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.python.builtins import builtin_functions
from ros2cc_extract.extract.static.python.interpreter import Interpreter
from ros2cc_extract.extract.static.python.machine.frame import BudgetError
from ros2cc_extract.extract.static.python.machine.library_table import Library, LibraryModel
from ros2cc_extract.extract.static.python.machine.machine import Machine
from ros2cc_extract.extract.static.python.machine.world import World
from ros2cc_extract.extract.static.python.values import values
from ros2cc_extract.extract.static.python.values.containers import Mapping, Sequence
from ros2cc_extract.extract.static.python.values.values import (
    ABSENT,
    NONE,
    Call,
    Const,
    Mystery,
    Value,
    options_of,
)
from ros2cc_extract.source_locations import Place, Unknown

_SETUP = 'setuptools.setup'
_STEPS = 100_000
_DECLARING = ('entry_points', 'scripts', 'data_files', '**')
_JOINS = ('os.path.join', 'posixpath.join')


class _SetupInterpreter(Interpreter):
    """Follows the file alone: what it imports may do anything, and is seldom there."""

    def import_module(self, name: str, place: Place) -> Value:
        """Everything is a library."""
        return self.library(name)


class _SetupModel(LibraryModel):
    """``setup`` by whichever name a library has it: setuptools, distutils, skbuild …"""

    def other_name(self, name: str) -> str:
        """The one name of it."""
        return _SETUP if name.endswith('.setup') else name


def of_setup_py(text: str, shown: str) -> Declarations:
    """What a ``setup.py`` declares; any module may be called so."""
    if not any(word in text for word in _DECLARING):
        return Declarations()
    project = Project.of_text(text, shown)
    source = project.given[0]
    if source.tree is None:
        why = next((d.message for d in source.diagnostics), 'it is no Python')
        return Declarations(unread=(Unknown(why, Place(shown)),))
    calls: list[Call] = []
    why_cut = _follow(project, source, calls)
    found: list[Found] = [each for call in calls for each in _of_call(call)]
    if why_cut is not None:
        found.append(Unknown(why_cut, Place(shown)))
    elif not calls:
        found.append(Unknown('no call of setup is found', Place(shown)))
    return declared(list(dict.fromkeys(found)))


def _follow(project: Project, source: SourceFile, calls: list[Call]) -> str | None:
    """Keep the calls of ``setup``; why the file could not be followed to its end."""

    def note(machine: Machine, receiver: Value, call: Call) -> Value:
        calls.append(call)
        return NONE

    table = Library(functions={_SETUP: note, **dict.fromkeys(_JOINS, _join)})
    model = _SetupModel([builtin_functions.TABLE, table], harmless=('',))
    machine = _SetupInterpreter(project, model, World())
    machine.world.is_program = True
    machine.steps_left = _STEPS
    try:
        with scanning_limits():
            machine.follow(source)
    except BudgetError:
        return 'it is too long to be followed'
    except RecursionError:
        return 'it is nested too deeply'
    finally:
        machine.store.reset()
    return None


def _join(machine: Machine, receiver: Value, call: Call) -> Value:
    """``os.path.join`` of texts."""
    parts = [part.value for part in call.args if isinstance(part, Const)]
    if call.more is not None or len(parts) < len(call.args) or not all(map(_is_text, parts)):
        return machine.mystery('a path that could not be followed', call.place)
    return Const('/'.join(part.rstrip('/') for part in parts))


def _is_text(value: object) -> bool:
    return isinstance(value, str)


def _of_call(call: Call) -> Iterator[Found]:
    entry_points = call.keywords.get('entry_points', NONE)
    for option in options_of(entry_points):
        yield from _of_entry_points(option, call.place)
    for option in options_of(call.keywords.get('scripts', NONE)):
        yield from _paths(option, call.place)
    for option in options_of(call.keywords.get('data_files', NONE)):
        yield from _of_data_files(option, call.place)
    if call.more is not None and 'entry_points' not in call.keywords:
        yield Unknown(f'arguments of setup: {call.more.reason}', call.more.at or call.place)


def _of_entry_points(value: Value, place: Place) -> Iterator[Found]:
    if isinstance(value, Const) and isinstance(value.value, str):
        yield from of_group_texts(value.value, place)
    elif isinstance(value, Mapping):
        for key, entry in value.entries.items():
            if isinstance(key, Const) and key.value in GROUPS:
                for option in options_of(entry):
                    yield from _of_group(option, place)
            elif not isinstance(key, Const):
                yield _open('a group of entry points', key, place)
        if value.rest is not None:
            yield Unknown(f'entry points: {value.rest.reason}', value.rest.at or place)
    elif not _is_nothing(value):
        yield _open('entry points', value, place)


def _of_group(value: Value, place: Place) -> Iterator[Found]:
    if isinstance(value, Const) and isinstance(value.value, str):
        yield from of_lines(value.value, lambda line: place)
    elif isinstance(value, Sequence):
        yield from _texts(value, place, 'an entry point', partial(read_entry, place=place))
    elif not _is_nothing(value):
        yield _open('console scripts', value, place)


def _paths(value: Value, place: Place) -> Iterator[Found]:
    """``scripts=[…]``."""
    if isinstance(value, Sequence):
        yield from _texts(value, place, 'a script', partial(Program, place=place))
    elif not _is_nothing(value):
        yield _open('scripts', value, place)


def _of_data_files(value: Value, place: Place) -> Iterator[Found]:
    """Pairs of a folder and files; only those that become programs are of interest."""
    for item in value.items if isinstance(value, Sequence) else ():
        for option in options_of(item):
            pair = option.items if isinstance(option, Sequence) else ()
            target = pair[0] if len(pair) == 2 else None
            is_text = isinstance(target, Const) and isinstance(target.value, str)
            if is_text and str(target.value).startswith('lib/'):  # type: ignore[union-attr]
                yield from _paths(pair[1], place)


def _texts(
    value: Sequence, place: Place, what: str, read: Callable[[str], Found]
) -> Iterator[Found]:
    for item in value.items:
        for option in options_of(item):
            if isinstance(option, Const) and isinstance(option.value, str):
                yield read(option.value)
            elif option is not ABSENT:
                yield _open(what, option, place)
    if value.rest is not None:
        yield Unknown(f'{what}: {value.rest.reason}', value.rest.at or place)


def _open(what: str, value: Value, place: Place) -> Unknown:
    if isinstance(value, Mystery):
        return Unknown(f'{what}: {value.unknown.reason}', value.unknown.at or place)
    if isinstance(value, values.Library):
        return Unknown(f'{what}: {value.name} is not followed', place)
    return Unknown(f'{what} is computed when setup.py runs', place)


def _is_nothing(value: Value) -> bool:
    return value is ABSENT or value == NONE
