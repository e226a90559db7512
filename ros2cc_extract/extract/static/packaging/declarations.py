"""What a Python package says that it installs as programs, and what of it could not be read."""

from __future__ import annotations

import re

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, Unknown

GROUPS = ('console_scripts', 'gui_scripts')
"""Groups of entry points that become programs."""
_ENTRY = re.compile(r'\s*(?P<name>[^=\s][^=]*?)\s*=\s*(?P<target>.*?)\s*(?:\[[^\]]*\])?\s*')
_TARGET = re.compile(r'(?P<module>\w+(?:\.\w+)*)\s*:\s*(?P<function>\w+(?:\.\w+)*)')


@dataclass(frozen=True)
class Script:
    """
    A program that calls a function.

    :param place: of the declaration, the line alone where no more is known.
    """

    name: str
    module: str
    function: str
    place: Place


@dataclass(frozen=True)
class Program:
    """A file that is installed as a program under its own name; ``path`` is as it is written."""

    path: str
    place: Place

    @property
    def name(self) -> str:
        """How it is called when it is installed."""
        return self.path.rpartition('/')[2]


@dataclass(frozen=True)
class Declarations:
    """
    All that the files of one package declare.

    :param unread: why there may be more programs than these.
    """

    scripts: tuple[Script, ...] = ()
    programs: tuple[Program, ...] = ()
    unread: tuple[Unknown, ...] = ()

    def __add__(self, other: Declarations) -> Declarations:
        return Declarations(
            self.scripts + other.scripts,
            self.programs + other.programs,
            self.unread + other.unread,
        )


def read_entry(text: str, place: Place) -> Script | Unknown:
    """
    Read ``name = module:function [extras]``.

    Source: packaging.python.org, "Entry points specification".
    """
    entry = _ENTRY.fullmatch(text)
    if entry is None:
        return Unknown(
            f'entry point {_short(text)} is not of the form name = module:function', place
        )
    return read_target(entry['name'], entry['target'], place)


def read_target(name: str, text: str, place: Place) -> Script | Unknown:
    """Read ``module:function`` of the program ``name``."""
    target = _TARGET.fullmatch(text)
    if target is None:
        return Unknown(f'{_short(text)} of program {_short(name)} is not module:function', place)
    return Script(name, target['module'], target['function'], place)


def declared(found: list[Script | Program | Unknown]) -> Declarations:
    """All that was found, each kind by itself."""
    return Declarations(
        tuple(each for each in found if isinstance(each, Script)),
        tuple(each for each in found if isinstance(each, Program)),
        tuple(each for each in found if isinstance(each, Unknown)),
    )


def _short(text: str) -> str:
    return repr(text if len(text) <= 60 else f'{text[:57]}…')
