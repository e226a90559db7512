"""``[tool.ros2cc]`` of the nearest ``pyproject.toml``: what a project asks of every check."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any, cast

from ros2cc_extract.errors import InputError, did_you_mean
from ros2cc_extract.files import DISK, read_named
from ros2cc_extract.findings.filters.selection import Selection
from ros2cc_extract.findings.requirements import Requirement, read_requirements
from ros2cc_extract.findings.rules.registry import BY_CODE
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.assumptions import Assumptions, read_assumptions
from ros2cc_extract.version import PROGRAM

FILE = 'pyproject.toml'
TABLE = 'ros2cc'
REQUIREMENTS = ('never_together', 'can_overlap', 'never_starves')
MOST_BYTES = 8_000_000
LONGEST_S = 1e9
ADDRESS = re.compile(r'(?:https?://|file:///)[!-~]+')
KEYS = (*REQUIREMENTS, 'ignore', 'per_path', 'assume', 'baseline', 'timeout', 'docs_url')


@dataclass(frozen=True, kw_only=True)
class Config:
    """
    What the table says; the command line goes before it.

    :param root: folder of the file, to which paths in it are relative.
    :param docs_url: where the pages of ``docs/`` stand on the web, as ``make site`` builds them.
    """

    root: Path
    selection: Selection = field(default_factory=Selection)
    requirements: tuple[Requirement, ...] = ()
    assumptions: tuple[str, ...] = ()
    baseline: Path | None = None
    timeout: float | None = None
    docs_url: str = ''


def load_config(start: Path) -> Config:
    """
    Read the table of the first ``pyproject.toml`` at or above ``start`` that has one.

    :raises InputError: when the file is no TOML, or a key of the table is unknown or malformed.
    """
    folder = start if start.is_dir() else start.parent
    for candidate in (folder.resolve(), *folder.resolve().parents):
        path = candidate / FILE
        if DISK.is_file(path):
            table = _parse(path)
            if table is not None:
                return _config(table, path)
    return Config(root=Path.cwd())


def read_config(path: Path) -> Config:
    """
    Read the table of one TOML file.

    :raises InputError: as ``load_config``; also when the file cannot be read or has no table.
    """
    table = _parse(path, 'name a TOML file')
    if table is None:
        raise InputError(f'no table [tool.{TABLE}]', Place(str(path)), 'add one')
    return _config(table, path)


def assumptions_of(config: Config, given: Sequence[str]) -> Assumptions:
    """Join the table's assumptions with those of the command line, which win."""
    place = Place(str(config.root / FILE))
    read_assumptions(config.assumptions, place)
    return read_assumptions([*config.assumptions, *given])


def _parse(path: Path, mend: str = 'mend the file') -> Mapping[str, Any] | None:
    try:
        data = _read_toml(read_named(path, MOST_BYTES, mend).decode('utf-8'), path)
    except UnicodeDecodeError:
        raise InputError('no TOML: no UTF-8 text', Place(str(path)), mend) from None
    except ValueError as error:  # also of a number or a date that Python has not
        raise InputError(f'no TOML: {error}', Place(str(path)), mend) from None
    except RecursionError:
        raise InputError('it is nested too deeply', Place(str(path)), mend) from None
    tool = data.get('tool', {})
    table = tool.get(TABLE) if isinstance(tool, dict) else None
    if table is not None and not isinstance(table, dict):
        raise _malformed(path, TABLE, 'a table')
    return table


def _read_toml(text: str, path: Path) -> Mapping[str, Any]:
    """Read it where that can be done: of Python 3.10, as in Humble, rosdep names no tomli."""
    try:
        if sys.version_info >= (3, 11):
            import tomllib
        else:
            import tomli as tomllib
    except ImportError:
        if TABLE not in text:
            return {}
        what = f'Python {sys.version_info[0]}.{sys.version_info[1]} cannot read TOML by itself'
        raise InputError(what, Place(str(path)), 'install tomli') from None
    read: Mapping[str, Any] = tomllib.loads(text)
    return read


def _config(table: Mapping[str, Any], path: Path) -> Config:
    for key in table:
        if key not in KEYS:
            raise InputError(
                f'unknown key {key!r} in [tool.{TABLE}]',
                Place(str(path)),
                did_you_mean(key, KEYS) or f'known keys: {", ".join(KEYS)}',
            )
    baseline = table.get('baseline')
    if baseline is not None and not isinstance(baseline, str):
        raise _malformed(path, 'baseline', 'a path')
    timeout = table.get('timeout')
    if timeout is not None and not _is_seconds(timeout):
        raise _malformed(path, 'timeout', 'a number of seconds')
    return Config(
        root=path.parent,
        selection=Selection(
            ignore=_rules(table.get('ignore', []), path, 'ignore'),
            per_path=_per_path(table.get('per_path', {}), path),
        ),
        requirements=read_requirements(table, Place(str(path))),
        assumptions=_texts(table.get('assume', []), path, 'assume'),
        baseline=path.parent / baseline if baseline is not None else None,
        timeout=timeout,
        docs_url=_address(table.get('docs_url', ''), path),
    )


def _address(value: object, path: Path) -> str:
    """An absolute address, since a report is read from another folder."""
    if value == '':
        return ''
    if not isinstance(value, str) or not ADDRESS.fullmatch(value):
        raise _malformed(
            path, 'docs_url', 'an address that begins with https://, http:// or file:///'
        )
    return value


def _is_seconds(value: object) -> bool:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return is_number and 0 < cast(float, value) <= LONGEST_S


def _per_path(value: object, path: Path) -> tuple[tuple[str, tuple[str, ...]], ...]:
    if not isinstance(value, dict):
        raise _malformed(path, 'per_path', 'a table of patterns')
    return tuple(
        (pattern, _rules(codes, path, f'per_path."{pattern}"')) for pattern, codes in value.items()
    )


def _rules(value: object, path: Path, key: str) -> tuple[str, ...]:
    """Codes of rules, or beginnings of such: another word would switch off nothing."""
    codes = _texts(value, path, key)
    wrong = [code for code in codes if not any(known.startswith(code) for known in BY_CODE)]
    if wrong:
        raise InputError(
            f'{wrong[0]!r} in {key} of [tool.{TABLE}] is no rule',
            Place(str(path)),
            did_you_mean(wrong[0], BY_CODE) or f'`{PROGRAM} explain` lists them',
        )
    return codes


def _texts(value: object, path: Path, key: str) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise _malformed(path, key, 'a list of texts')
    return tuple(value)


def _malformed(path: Path, key: str, wanted: str) -> InputError:
    return InputError(f'{key} of [tool.{TABLE}] must be {wanted}', Place(str(path)))
