"""
Files of the user's cache folder: pickled values that this tool alone writes.

A damaged or foreign file counts as none, and a folder that cannot be written is no error.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import tempfile
from collections.abc import Iterable
from pathlib import Path

MOST_FILES = 4_000
"""With more, the older half goes; a file is as old as its last use."""

_UNREADABLE = (
    OSError,
    pickle.UnpicklingError,
    EOFError,
    AttributeError,
    ImportError,
    IndexError,
    KeyError,
    TypeError,
    ValueError,
)


def default_cache_folder() -> Path:
    """The tool's folder in the user's cache (XDG base directory specification)."""
    base = os.environ.get('XDG_CACHE_HOME')
    return (Path(base) if base else Path.home() / '.cache') / 'ros2cc-extract'


def load_value(path: Path) -> object:
    """What was stored, ``None`` where there is nothing that can be used."""
    try:
        value: object = pickle.loads(path.read_bytes())
    except _UNREADABLE:
        return None
    with contextlib.suppress(OSError):
        os.utime(path)
    return value


def store_value(path: Path, value: object) -> None:
    """Write whole or not at all."""
    name = None
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent)
        with os.fdopen(handle, 'wb') as stream:
            pickle.dump(value, stream, pickle.HIGHEST_PROTOCOL)
        Path(name).replace(path)
    except BaseException as error:
        if name is not None:
            Path(name).unlink(missing_ok=True)
        if not isinstance(error, OSError):
            raise


def tidy(folder: Path) -> None:
    """Remove the older half where too many files have come together."""
    try:
        files = list(os.scandir(folder))
        if len(files) <= MOST_FILES:
            return
        oldest = sorted(files, key=lambda file: (file.stat().st_mtime_ns, file.name))
        for file in oldest[: len(files) // 2]:
            Path(file.path).unlink(missing_ok=True)
    except OSError:
        return


def code_version(folders: Iterable[Path]) -> list[str]:
    """Size and time of the tool's own files: another version may say something else."""
    found = []
    for folder in folders:
        with os.scandir(folder) as files:
            for file in sorted(files, key=lambda file: file.name):
                if file.is_file() and not file.name.endswith('.pyc'):
                    status = file.stat()
                    found.append(f'{file.name} {status.st_size} {status.st_mtime_ns}')
    return found
