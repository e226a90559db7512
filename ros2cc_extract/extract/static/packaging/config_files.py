"""
Programs that ``setup.cfg`` and ``pyproject.toml`` declare.

Sources: setuptools, "Configuring setuptools using setup.cfg files"; packaging.python.org,
"pyproject.toml specification"; Poetry, "scripts".
"""

from __future__ import annotations

import configparser
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ros2cc_extract.extract.static.packaging.declarations import (
    GROUPS,
    Declarations,
    Program,
    Script,
    declared,
    read_entry,
    read_target,
)
from ros2cc_extract.source_locations import Place, Unknown

_WITHOUT_TOML = 'Python before 3.11 cannot read it by itself: install tomli'
_MAY_DECLARE = re.compile(r'scripts|entry-points|script-files')
# configparser keeps a list of all that is wrong, which takes the square of its length.
_MOST_LETTERS = 100_000
# Words that are no line of their own are looked for in every line.
_MOST_SEARCHES = 1_000
Found = Script | Program | Unknown


def of_cfg(text: str, shown: str) -> Declarations:
    """What a ``setup.cfg`` declares."""
    parser = configparser.ConfigParser(interpolation=None, strict=False, delimiters=('=', ':'))
    try:
        _read_ini(parser, text)
    except (configparser.Error, ValueError) as error:
        return _unreadable(error, shown)
    place = _Places(text, shown)
    found: list[Found] = []
    for group in GROUPS:
        found += of_lines(parser.get('options.entry_points', group, fallback=''), place.of)
    for line in parser.get('options', 'scripts', fallback='').replace(',', '\n').splitlines():
        if line.strip():
            found.append(Program(line.strip(), place.of(line.strip())))
    return declared(found)


def of_group_texts(text: str, place: Place) -> Iterator[Found]:
    """Entry points in the form of an INI file, as ``setup(entry_points=…)`` takes them too."""
    parser = configparser.ConfigParser(interpolation=None, strict=False, delimiters=('=',))
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    try:
        _read_ini(parser, text)
    except (configparser.Error, ValueError) as error:
        yield Unknown(f'entry points cannot be read: {_first_line(error)}', place)
        return
    for group in GROUPS:
        if parser.has_section(group):
            for name, target in parser.items(group):
                yield read_entry(f'{name} = {target}', place)


def _read_ini(parser: configparser.ConfigParser, text: str) -> None:
    if len(text) > _MOST_LETTERS:
        raise ValueError(f'it is longer than {_MOST_LETTERS} letters')
    parser.read_string(text)


def of_lines(text: str, place_of: Callable[[str], Place]) -> Iterator[Found]:
    """Entry points of one group, each in a line of its own."""
    for line in text.splitlines():
        if line.strip() and not line.lstrip().startswith('#'):
            yield read_entry(line, place_of(line.strip()))


def of_toml(text: str, shown: str) -> Declarations:
    """What a ``pyproject.toml`` declares."""
    if not _MAY_DECLARE.search(text):
        return Declarations()
    try:
        data = _read_toml(text)
    except ImportError:
        return Declarations(unread=(Unknown(_WITHOUT_TOML, Place(shown)),))
    except (ValueError, RecursionError) as error:
        return _unreadable(error, shown)
    return declared(list(_of_tables(data, _Places(text, shown))))


def _of_tables(data: Mapping[str, Any], place: _Places) -> Iterator[Found]:
    project = _table(data, 'project')
    entry_points = _table(project, 'entry-points')
    for table in (
        *(_table(project, name) for name in ('scripts', 'gui-scripts')),
        *(_table(entry_points, group) for group in GROUPS),
        _table(_table(_table(data, 'tool'), 'poetry'), 'scripts'),
    ):
        for name, target in table.items():
            yield _of_entry(name, target, place.of(name))
    files = _table(_table(data, 'tool'), 'setuptools').get('script-files')
    for path in files if isinstance(files, list) else ():
        if isinstance(path, str):
            yield Program(path, place.of(path))


def _of_entry(name: str, target: object, place: Place) -> Found:
    if isinstance(target, Mapping):  # of Poetry, with what else holds for it
        kind = target.get('type')
        target = target.get('reference') or target.get('callable')
        if kind == 'file' and isinstance(target, str):
            return Program(target, place)
    if not isinstance(target, str):
        return Unknown(f'target of program {name!r} is no text', place)
    return read_target(name, target.partition('[')[0].strip(), place)


def _table(data: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    found = data.get(name)
    return found if isinstance(found, Mapping) else {}


def _read_toml(text: str) -> Mapping[str, Any]:
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    read: Mapping[str, Any] = tomllib.loads(text)
    return read


class _Places:
    """The line in which a word begins: the parsers do not keep it."""

    def __init__(self, text: str, shown: str) -> None:
        self._lines = [line.strip().strip('"\'') for line in text.splitlines()]
        self._whole: dict[str, int] = {}
        for number, line in enumerate(self._lines, 1):
            self._whole.setdefault(line, number)
            self._whole.setdefault(line.partition('=')[0].strip(' "\''), number)
        self._searches = 0
        self._shown = shown

    def of(self, word: str) -> Place:
        """The line that is ``word`` or sets it; else the first that begins with it, or has it."""
        return Place(self._shown, self._whole.get(word.strip('"\'')) or self._searched(word))

    def _searched(self, word: str) -> int:
        self._searches += 1
        if self._searches > _MOST_SEARCHES:
            return 0
        begins = (n for n, line in enumerate(self._lines, 1) if line.startswith(word))
        has = (n for n, line in enumerate(self._lines, 1) if word in line)
        return next(begins, 0) or next(has, 0)


def _unreadable(error: Exception, shown: str) -> Declarations:
    why = Unknown(f'it cannot be read: {_first_line(error)}', Place(shown))
    return Declarations(unread=(why,))


def _first_line(error: Exception) -> str:
    return ' '.join(str(error).split())[:200] or type(error).__name__
