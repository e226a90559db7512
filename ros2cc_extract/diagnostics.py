"""What we tell about the user's program: a leaf for every room."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from ros2cc_extract.places import Place


class Severity(Enum):
    """How much a diagnostic weighs: a note never changes the exit status."""

    ERROR = 'error'
    WARNING = 'warning'
    NOTE = 'note'


UNREAD = frozenset(
    {
        'unreadable-file',
        'file-too-large',
        'binary-file',
        'undecodable-file',
        'syntax-error',
        'python-2',
        'nested-too-deeply',
    }
)
"""Slugs of files that could not be read: nothing in them was looked at."""


@dataclass(frozen=True, kw_only=True)
class Diagnostic:
    """
    One thing the extractor noticed.

    :param slug: stable short name, by which docs and filters call it (``syntax-error``).
    :param message: one clause, no final stop.
    :param help: how to mend, empty where nothing can be said.
    """

    severity: Severity
    slug: str
    place: Place
    message: str
    help: str = ''
