"""
Errors of the tool: where, what, how to mend, in that order.

A leaf that every room may import. An error here is about *our* input; what is wrong in the
user's program is a diagnostic (``diagnostics.py``), not an exception.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from ros2cc_extract.source_locations import Place


class Ros2ccError(Exception):
    """
    Base of all errors a user may meet.

    :param what: what is wrong, one clause without a final stop.
    :param place: file, with line and column where known.
    :param mend: how to mend it; empty where there is nothing to add.
    """

    def __init__(self, what: str, place: Place | None = None, mend: str = '') -> None:
        super().__init__(what, place, mend)
        self.what = what
        self.place = place
        self.mend = mend

    def __str__(self) -> str:
        where = f'{self.place}: ' if self.place else ''
        mend = f'; {self.mend}' if self.mend else ''
        return f'{where}{self.what}{mend}'


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Ask for the known name that is nearest to a wrong one; empty where none is near."""
    return ''.join(f'did you mean {close!r}?' for close in get_close_matches(name, known, n=1))


class InputError(Ros2ccError):
    """A file or argument that cannot be used."""


class SpecFormatError(InputError):
    """A YAML specification that is not of the published format or of ours."""


class ModelFormatError(InputError):
    """A UPPAAL model or query that does not parse, is out of the subset, or breaks a range."""


class IncompleteSpecError(Ros2ccError):
    """A specification with a hole that no policy closes."""


class ToolNotFoundError(Ros2ccError):
    """An external program that was asked for and is not there or does not work."""


class CoreMismatchError(Ros2ccError):
    """A replay disagrees with the search that gave the path: a defect of this tool."""
