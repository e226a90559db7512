"""
Files of the user's cache folder, which this tool alone writes.

What is in them is believed: verdicts and findings are reported from there. So a folder or a file
that another user can change counts as none, and each file says by a checksum that it is what was
written under its name. Nothing in it can run: it is JSON, and makes values of known types.

A damaged or foreign file counts as none, and a folder that cannot be written is no error.
"""

from __future__ import annotations

import gc
import importlib
import json
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from hashlib import sha256
from io import FileIO
from pathlib import Path
from typing import TypeVar

from ros2cc_extract.file_ownership import changeable_by_others, open_to_others
from ros2cc_extract.files import open_regular
from ros2cc_extract.json_text import read_json
from ros2cc_extract.plain_data import Packer, PackingError

T = TypeVar('T')

MOST_FILES = 4_000
"""With more, the older half goes; a file is as old as its last use."""
MOST_BYTES = 200_000_000
"""Of one file; more is neither written nor read."""
_MARK = b'ros2cc-extract cache 2 '
_HEADER_BYTES = len(_MARK) + 2 * 32 + 1


def default_cache_folder() -> Path | None:
    """
    Give the tool's folder in the user's cache (XDG base directory specification).

    ``None`` where the user has neither such a folder nor a home.
    """
    base = os.environ.get('XDG_CACHE_HOME')
    try:
        return (Path(base) if base else Path.home() / '.cache') / 'ros2cc-extract'
    except RuntimeError:
        return None


def who_can_change(folder: Path) -> Path | None:
    """
    Give the folder by which another user could change what is, or will be, in ``folder``.

    ``None`` if no other user could, or if that cannot be found out.
    """
    try:
        there = next(each for each in (folder, *folder.absolute().parents) if each.exists())
        return open_to_others(there)
    except (OSError, StopIteration):
        return None


def load_value(path: Path, packer: Packer[T]) -> T | None:
    """What was stored, ``None`` where there is nothing that can be used."""
    content = load_content(path)
    if content is None:
        return None
    try:
        with _no_collection():
            return packer.unpack(read_json(content))
    except (PackingError, ValueError, RecursionError):
        return None


@contextmanager
def _no_collection() -> Iterator[None]:
    """
    Make many values without a look for unused ones, which takes longer than making them.

    After it they are old for the collector, so that it does not go through them at once.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collects:
            if not gc.get_freeze_count():
                gc.freeze()
                gc.unfreeze()
            gc.enable()


def store_value(path: Path, value: T, packer: Packer[T]) -> None:
    """Write whole or not at all."""
    store_content(path, json.dumps(packer.pack(value), separators=(',', ':')).encode())


def load_content(path: Path) -> bytes | None:
    """What was stored, byte for byte; ``None`` where there is nothing that can be used."""
    try:
        own = _own_folder(path.parent) / path.name
        with open_regular(own, follow=False) as stream:
            status = os.fstat(stream.fileno())
            if changeable_by_others(status) or status.st_size > MOST_BYTES:
                return None
            header, content = stream.read(_HEADER_BYTES), stream.read()
        if header != _header(path.name, content):
            return None
        os.utime(own)
    except OSError:
        return None
    return content


def store_content(path: Path, content: bytes) -> bool:
    """Write whole or not at all, and say which."""
    if len(content) > MOST_BYTES - _HEADER_BYTES:
        return False
    name = None
    try:
        _make_private(path.parent)
        folder = _own_folder(path.parent)
        handle, name = tempfile.mkstemp(dir=folder)
        with os.fdopen(handle, 'wb') as stream:
            stream.write(_header(path.name, content))
            stream.write(content)
        Path(name).replace(folder / path.name)
    except BaseException as error:
        if name is not None:
            Path(name).unlink(missing_ok=True)
        if not isinstance(error, OSError):
            raise
        return False
    return True


def _header(name: str, content: bytes) -> bytes:
    """With the name: what was put under another key is no answer here."""
    digest = sha256(name.encode() + b'\0')
    digest.update(content)
    return _MARK + digest.hexdigest().encode() + b'\n'


@cache
def _own_folder(folder: Path) -> Path:
    """
    Return the path to a folder that no other user can redirect.

    :raises OSError: if another user can, or there is no such folder.
    """
    own = folder.resolve(strict=True)
    if open_to_others(own) is not None:
        raise PermissionError(f'{folder} can be changed by others')
    return own


def _make_private(folder: Path) -> None:
    """Make a folder and those above it, closed to others with any umask."""
    if not folder.is_dir():
        if folder.parent != folder:
            _make_private(folder.parent)
        folder.mkdir(mode=0o700, exist_ok=True)


def tidy(folder: Path) -> None:
    """Remove the older half where too many files have come together."""
    try:
        files = list(os.scandir(_own_folder(folder)))
        if len(files) <= MOST_FILES:
            return
        oldest = sorted(files, key=lambda file: (file.stat().st_mtime_ns, file.name))
        for file in oldest[: len(files) // 2]:
            Path(file.path).unlink(missing_ok=True)
    except OSError:
        return


@cache
def tool_version() -> str:
    """
    Equal where the same program runs: this tool's own files, and the Python that runs them.

    By content and not by time: one version has the same answers wherever it is installed anew.
    """
    python = (sys.implementation.cache_tag, sys.version_info[:3])
    digest = sha256(repr(python).encode())
    for name, path in _own_files():
        with FileIO(path) as stream:  # no buffers: there are hundreds of files
            content = stream.readall()
        digest.update(f'\0{name} {len(content)}\0'.encode())
        digest.update(content)
    return digest.hexdigest()


def _own_files() -> Iterator[tuple[str, str]]:
    """In a checkout the generator stands beside the other rooms, and else among them."""
    package = str(Path(__file__).resolve().parent)
    places = importlib.import_module('ros2cc_extract.generator').__path__
    for root in dict.fromkeys((package, *places)):
        for folder, folders, files in os.walk(root):
            folders[:] = sorted(each for each in folders if each != '__pycache__')
            # Texts, and no paths: of hundreds of files these would take longer than reading.
            yield from (
                (f'{folder[len(root) :]}/{file}', f'{folder}/{file}') for file in sorted(files)
            )
