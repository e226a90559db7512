"""
Reading files that may be anything: only regular ones, by descriptor, up to a stated size.

A scan asks for files through ``Files``, so that it sees those of another revision as it sees
those of the disk.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, Protocol

from ros2cc_extract.errors import InputError
from ros2cc_extract.source_locations import Place

Walked = tuple[str, list[str], list[str]]
"""A folder, and the names of the folders and of the other files in it."""
OnError = Callable[[OSError], None]


class Files(Protocol):
    """Where a scan looks for files."""

    def __hash__(self) -> int:
        """One place to look is another than the next."""

    def exists(self, path: Path) -> bool:
        """Whether there is anything at ``path``, as far as one may look."""

    def is_file(self, path: Path) -> bool:
        """Whether a regular file is there; also one without permission: reading it says so."""

    def is_folder(self, path: Path) -> bool:
        """Whether a folder is there."""

    def read(self, path: Path, most_bytes: int) -> bytes:
        """
        Read a regular file whole.

        :raises OSError: when it cannot be opened, is not a regular file, or is larger.
        """

    def walk(self, folder: Path, on_error: OnError) -> Iterator[Walked]:
        """Walk as ``os.walk`` does: folders that the caller removes from the list are left out."""


class Disk:
    """The files as they are now."""

    def exists(self, path: Path) -> bool:
        """See ``Files``."""
        return _mode(path) is not None

    def is_file(self, path: Path) -> bool:
        """See ``Files``."""
        mode = _mode(path)
        return mode is not None and (mode == _BARRED or stat.S_ISREG(mode))

    def is_folder(self, path: Path) -> bool:
        """See ``Files``."""
        return stat.S_ISDIR(_mode(path) or 0)

    def read(self, path: Path, most_bytes: int) -> bytes:
        """See ``Files``."""
        return read_regular(path, most_bytes)

    def walk(self, folder: Path, on_error: OnError) -> Iterator[Walked]:
        """See ``Files``."""
        return os.walk(folder, onerror=on_error)


DISK = Disk()
_BARRED = 0
_NOTHING_THERE = (errno.ENOENT, errno.ENOTDIR, errno.ELOOP, errno.ENAMETOOLONG)


@contextmanager
def open_regular(path: Path, *, follow: bool = True) -> Iterator[BinaryIO]:
    """
    Open a file for reading.

    What is read is what was looked at, since both are done by one descriptor; a FIFO or a device
    is not waited for.

    :param follow: open what a symbolic link leads to.
    :raises OSError: when it cannot be opened, or is not a regular file.
    """
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    try:
        descriptor = os.open(path, flags | (0 if follow else os.O_NOFOLLOW))
    except ValueError as error:
        raise OSError(errno.EINVAL, 'no file can have this name', str(path)) from error
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise OSError(errno.EINVAL, 'it is not a regular file', str(path))
        with os.fdopen(descriptor, 'rb', closefd=False) as stream:
            yield stream
    finally:
        os.close(descriptor)


def read_regular(path: Path, most_bytes: int, *, follow: bool = True) -> bytes:
    """
    Read a file whole, as ``open_regular`` opens it.

    :raises OSError: when it cannot be opened, is not a regular file, or is larger.
    """
    with open_regular(path, follow=follow) as stream:
        size = os.fstat(stream.fileno()).st_size
        # Not ``most_bytes`` at once, which would allocate as much memory.
        content = b'' if size > most_bytes else stream.read(size + 1)
        if len(content) > size:
            content += stream.read(most_bytes + 1 - len(content))
    if max(size, len(content)) > most_bytes:  # it may have grown since
        raise too_large(path, most_bytes)
    return content


def read_named(path: Path, most_bytes: int, mend: str = '', *, pipes: bool = False) -> bytes:
    """
    Read a file that the user named.

    :param mend: what the user may do where it cannot be read.
    :param pipes: wait for what comes through a pipe, too.
    :raises InputError: when it cannot be read, or is larger.
    """
    try:
        if pipes and path.is_fifo():
            with path.open('rb') as stream:
                return read_stream(stream, most_bytes, str(path))
        return read_regular(path, most_bytes)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise InputError(f'cannot be read: {reason}', Place(str(path)), mend) from error


def read_stream(stream: BinaryIO, most_bytes: int, name: str) -> bytes:
    """
    Read what comes through a pipe.

    :raises InputError: when it is more than ``most_bytes``.
    """
    content = stream.read(most_bytes + 1)
    if len(content) > most_bytes:
        raise InputError(f'cannot be read: it is larger than {most_bytes} bytes', Place(name))
    return content


def real_path(path: Path | str) -> Path:
    """The path without symbolic links as far as they lead anywhere; ``Path.resolve`` may raise."""
    try:
        return Path(os.path.realpath(path))
    except ValueError:  # no file can have this name
        return Path(path)


def too_large(path: Path, most_bytes: int) -> OSError:
    """The error of a file that is larger than the limit."""
    return OSError(errno.EFBIG, f'it is larger than {most_bytes} bytes', str(path))


def _mode(path: Path) -> int | None:
    """Kind of the file at ``path``; ``None`` if there is no file."""
    try:
        return os.stat(path).st_mode  # noqa: PTH116  a third of the time that Path.stat() takes
    except OSError as error:
        return None if error.errno in _NOTHING_THERE else _BARRED
    except ValueError:  # no system takes such a name
        return None
