"""The standard streams as they may be: closed, full, or of an encoding that lacks signs."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Callable
from typing import TextIO

from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place

UTF_8 = 'utf-8'
ESCAPED = 'backslashreplace'
"""A character that the stream cannot encode is written as its number, and is no error."""


class Careless(io.TextIOWrapper):
    """Messages: if nobody can read them, that is no error."""

    def write(self, text: str) -> int:
        """Write, if that can be done."""
        try:
            return super().write(text)
        except OSError:
            silence(self)
            return len(text)

    def flush(self) -> None:
        """Write what is left, if that can be done."""
        try:
            super().flush()
        except OSError:
            silence(self)


class Watched(io.TextIOWrapper):
    """Results: if they cannot be written, that is an error."""

    def write(self, text: str) -> int:
        """
        Write.

        :raises InputError: when that cannot be done, except for a pipe without a reader.
        """
        try:
            return super().write(text)
        except BrokenPipeError:
            raise
        except OSError as error:
            raise self._refused(error) from None

    def flush(self) -> None:
        """Write what is left; see ``write``."""
        try:
            super().flush()
        except BrokenPipeError:
            raise
        except OSError as error:
            raise self._refused(error) from None

    def _refused(self, error: OSError) -> InputError:
        silence(self)
        return InputError(f'cannot be written: {error.strerror}', Place('<stdout>'))


def with_streams(program: Callable[[TextIO, TextIO], int]) -> int:
    """Run ``program`` with streams to write to, even if the process was started without any."""
    _open_closed()
    if isinstance(sys.stdout, io.TextIOWrapper):
        encoding, by_line = sys.stdout.encoding, sys.stdout.line_buffering
        sys.stdout = Watched(sys.stdout.detach(), encoding, ESCAPED, line_buffering=by_line)
    if isinstance(sys.stderr, io.TextIOWrapper):
        sys.stderr = Careless(
            sys.stderr.detach(), sys.stderr.encoding, ESCAPED, line_buffering=True
        )
    status = program(sys.stdout, sys.stderr)
    sys.stderr.flush()
    return status


def as_utf_8(stream: TextIO) -> None:
    """Write UTF-8 in every locale, since other programs read it."""
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(encoding=UTF_8, errors=ESCAPED)


def silence(stream: TextIO) -> None:
    """Send what could not be written nowhere, so that it is not tried once more at exit."""
    descriptor = os.open(os.devnull, os.O_WRONLY)
    os.dup2(descriptor, stream.fileno())
    os.close(descriptor)


def _open_closed() -> None:
    """
    Fill the places of closed streams, which files of our own would take otherwise.

    What is read is empty, messages are lost, and a result that is lost is an error.
    """
    for descriptor, flags in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, flags)
    if sys.stdin is None:
        sys.stdin = open(0, encoding=UTF_8, closefd=False)  # noqa: SIM115
    if sys.stdout is None:
        sys.stdout = open(1, 'w', encoding=UTF_8, closefd=False)  # noqa: SIM115
    if sys.stderr is None:
        sys.stderr = open(2, 'w', encoding=UTF_8, closefd=False)  # noqa: SIM115
