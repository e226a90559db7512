"""
Which files only this user, and root, can have changed.

What is handed to another process, or believed because we wrote it ourselves, must not be
replaceable: not by its own mode, and not by a rename in a folder above it.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path

ROOT = 0


def open_to_others(folder: Path) -> Path | None:
    """
    Give the folder, or the nearest above it, in which another user could rename things.

    A sticky folder, such as ``/tmp``, lets a user rename only own files.

    :raises OSError: when one of them cannot be looked at.
    """
    for each in _upwards(folder.resolve(strict=True)):
        status = each.stat()
        if changeable_by_others(status) and not (is_own(status) and status.st_mode & stat.S_ISVTX):
            return each
    return None


def changeable_by_others(status: os.stat_result) -> bool:
    """Whether another user than this one and root owns a file or may write into it."""
    return not is_own(status) or bool(status.st_mode & (stat.S_IWGRP | stat.S_IWOTH))


def is_own(status: os.stat_result) -> bool:
    """Whether a file belongs to this user, or to root, which needs no rights."""
    # Where the system knows no users, as in a browser, all is of one.
    user = os.geteuid() if hasattr(os, 'geteuid') else ROOT
    return status.st_uid in (user, ROOT)


def _upwards(folder: Path) -> Iterator[Path]:
    yield folder
    yield from folder.parents


def user_of_process(pid: int) -> int | None:
    """
    Return the user that a process acts as; ``None`` if its user numbers differ (proc(5), status).

    :raises OSError: when there is no such process.
    """
    for line in Path(f'/proc/{pid}/status').read_text(errors='replace').splitlines():
        if line.startswith('Uid:'):
            users = set(map(int, line.split()[1:]))
            return users.pop() if len(users) == 1 else None
    return None
