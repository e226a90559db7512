"""Messages about the user's program; every package may import this module."""

from __future__ import annotations

import os
from enum import Enum

from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place, shown_name


class Severity(Enum):
    """How much a diagnostic weighs: a note never changes the exit status."""

    ERROR = 'error'
    WARNING = 'warning'
    NOTE = 'note'


UNREAD = frozenset(
    {
        'unreadable-file',
        'unreadable-folder',
        'file-too-large',
        'binary-file',
        'undecodable-file',
        'syntax-error',
        'python-2',
        'nested-too-deeply',
        'internal-error',
    }
)
"""Slugs of files that could not be read: nothing in them was looked at."""
BARRED = frozenset({'unreadable-file', 'unreadable-folder'})
"""Those that the system did not let us read."""


@dataclass(frozen=True)
class RelatedPlace:
    """A place that belongs to a diagnostic, with what happens there."""

    place: Place
    text: str


@dataclass(frozen=True, kw_only=True)
class Diagnostic:
    """
    One thing the extractor noticed.

    :param slug: stable short name, by which docs and filters call it (``syntax-error``).
    :param message: one clause, no final stop.
    :param help: how to mend, empty where nothing can be said.
    :param related: other places that the message speaks of.
    """

    severity: Severity
    slug: str
    place: Place
    message: str
    help: str = ''
    related: tuple[RelatedPlace, ...] = ()


def unreadable_folder(error: OSError, shown: str | None = None) -> Diagnostic:
    """
    Report a folder that cannot be listed, with the severity of a file that is not read.

    :param shown: its path as shown to the user; as it was opened by default.
    """
    return Diagnostic(
        severity=Severity.ERROR,
        slug='unreadable-folder',
        place=Place(shown or shown_name(os.fsdecode(error.filename))),
        message=f'cannot be looked into: {error.strerror or error}',
        help='what is in it is not judged',
    )
