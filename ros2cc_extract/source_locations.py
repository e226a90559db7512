"""Places in source files, and facts that could not be found out; a leaf for every room."""

from __future__ import annotations

import os

from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True, order=True)
class Place:
    """
    A place in a file.

    :param file: path as shown to the user, with ``/`` as separator.
    :param line: 1-based, 0 when only the file is known.
    :param column: 1-based, 0 when only the line is known.
    """

    file: str
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        if not self.line:
            return self.file
        if not self.column:
            return f'{self.file}:{self.line}'
        return f'{self.file}:{self.line}:{self.column}'

    @staticmethod
    def parse(text: str) -> Place:
        """Read what ``str`` writes; the file name may itself contain colons."""
        head, _, last = text.rpartition(':')
        if not head or not _is_count(last):
            return Place(text)
        file, _, middle = head.rpartition(':')
        if file and _is_count(middle):
            return Place(file, int(middle), int(last))
        return Place(head, int(last))


def shown_name(path: str) -> str:
    """A path as text that every format can hold: bytes that are no UTF-8 stand as ``\\xff``."""
    try:
        return os.fsencode(path).decode('utf-8', 'backslashreplace')
    except UnicodeEncodeError:
        return path.encode('utf-8', 'backslashreplace').decode()


@dataclass(frozen=True)
class Unknown:
    """
    A fact that could not be found out; never replaced by a silent default.

    :param reason: why, as a clause a developer understands.
    :param at: the place that stopped us.
    """

    reason: str
    at: Place | None = None

    def __str__(self) -> str:
        return f'{self.reason} ({self.at})' if self.at else self.reason


def _is_count(text: str) -> bool:
    return text.isascii() and text.isdigit() and not text.startswith('0')
