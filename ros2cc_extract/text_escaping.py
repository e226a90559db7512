"""
Text that strangers wrote, for people to read: names, paths, topics, source lines.

Such text may hold what a terminal obeys (ESC, C1), what makes one line look like two, or what
turns the order of letters round (bidi controls). All that Python calls not printable is shown as
its escape, as source would write it, so that you see what is there. JSON and YAML have
escapes of their own.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import cache
from operator import is_
from typing import Any, TextIO, TypeVar, cast

T = TypeVar('T')
_STYLE = re.compile(r'(\x1b\[[0-9;]*m|\x1b\]8;(?:;|id=[-\d]*;file://[!-~]*)\x1b\\)')
"""A colour or a link to a file, as our own console writes it; it moves nothing."""

_COMMAND = re.compile(r'^[^\S\n]*:(?=:)|##(?=\[)', re.MULTILINE)
"""How commands of workflows begin: the one at the begin of a line, the other anywhere in it."""


def one_line(text: str) -> str:
    """Give text that stays on its line and does nothing there."""
    return text if text.isprintable() else ''.join(map(_shown, text))


def lines(text: str) -> str:
    """Give text in which only ends of lines, and tabs, are more than letters."""
    if text.isprintable():
        return text
    return ''.join(c if c in '\n\t' else _shown(c) for c in text)


def _shown(character: str) -> str:
    if character.isprintable():
        return character
    return character.encode('unicode_escape').decode()


def without_commands(text: str) -> str:
    """Give text in which GitHub, which reads every log, finds nothing to do."""
    return _COMMAND.sub(_escaped, text)


def _escaped(command: re.Match[str]) -> str:
    return f'{command[0][:-1]}\\x{ord(command[0][-1]):02x}'


def printable(value: T) -> T:
    """Give a value with all its text as ``one_line`` gives it; itself where that is the same."""
    return cast(T, _printable(value))


def _printable(value: Any) -> Any:
    if type(value) is str:
        return one_line(value)
    if type(value) in (tuple, list):
        each = [_printable(part) for part in value]
        return value if all(map(is_, each, value)) else type(value)(each)
    if isinstance(value, Mapping):
        return {_printable(key): _printable(part) for key, part in value.items()}
    if is_dataclass(value) and not isinstance(value, type | Enum):
        return _with_printable_fields(value)
    return value


def _with_printable_fields(value: Any) -> Any:
    own = value.__dict__
    changed = {}
    kind: Any = type(value)
    for name in _names_of_text(kind):
        new = _printable(own[name])
        if new is not own[name] and new != own[name]:
            changed[name] = new
    if not changed:
        return value
    made = object.__new__(type(value))
    # Not by its own checks: what it said of names was said of the real ones.
    left = {field.name: own[field.name] for field in fields(value)}
    object.__setattr__(made, '__dict__', left | changed)
    return made


@cache
def _names_of_text(kind: Any) -> tuple[str, ...]:
    """Fields that are not compared do not belong to a value, and may hold anything."""
    return tuple(field.name for field in fields(kind) if field.compare)


def json_text(data: object) -> str:
    """Write JSON for people and programs: letters as they are, and the rest as its escapes."""
    text = json.dumps(data, indent=2, ensure_ascii=False)
    if text.replace('\n', '').isprintable():
        return f'{text}\n'
    # Outside of its strings JSON has only what is printable, and ends of lines.
    escaped = (c if c == '\n' or c.isprintable() else json.dumps(c)[1:-1] for c in text)
    return f'{"".join(escaped)}\n'


class Shown:
    """
    A stream for people: nothing that is written to it is more than text.

    :param by_lines: each ``write`` is one line, as ``print`` has it, and no more than one.
    :param styled: lets colours through.
    :param in_log: nothing in it is a command to GitHub.
    """

    def __init__(
        self,
        stream: TextIO,
        *,
        by_lines: bool = False,
        styled: bool = False,
        in_log: bool = False,
    ) -> None:
        self.raw: TextIO = raw(stream)
        self._by_lines = by_lines
        self._styled = styled
        self._in_log = in_log or by_lines

    def write(self, text: str) -> int:
        cleaned = text if text == '\n' else self._cleaned(text)
        self.raw.write(without_commands(cleaned) if self._in_log else cleaned)
        return len(text)

    def writelines(self, parts: Iterable[str]) -> None:
        for part in parts:
            self.write(part)

    def _cleaned(self, text: str) -> str:
        if self._by_lines:
            end = '\n' if text.endswith('\n') else ''
            return one_line(text.removesuffix('\n')) + end
        if self._styled and '\x1b' in text:
            return ''.join(p if _STYLE.fullmatch(p) else lines(p) for p in _STYLE.split(text))
        return lines(text)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.raw, name)


def raw(stream: TextIO) -> TextIO:
    """Return the stream behind: for code that draws on a terminal, and escapes text itself."""
    return stream.raw if isinstance(stream, Shown) else stream
