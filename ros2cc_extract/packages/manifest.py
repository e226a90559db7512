"""ROS packages on the disk: which files of a folder are checked, and what a package is called."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from xml.etree import ElementTree

from ros2cc_extract.errors import InputError
from ros2cc_extract.files import DISK, OnError, read_regular, real_path
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place

MANIFEST = 'package.xml'
MOST_BYTES = 1_000_000
SKIP_MARKS = frozenset({'AMENT_IGNORE', 'COLCON_IGNORE', 'pyvenv.cfg'})
"""Folders that hold one of these are no source; ``colcon`` marks build, install and log."""


@dataclass(frozen=True)
class Package:
    """
    What is read of a ``package.xml``.

    :param build_type: ``ament_python``, ``ament_cmake``; empty when it is not stated.
    :param dependencies: every package it names as a dependency of any kind.
    """

    folder: Path
    name: str
    build_type: str
    dependencies: frozenset[str]


def read_package(folder: Path) -> Package:
    """
    Read the manifest of a package.

    :raises InputError: if there is none, or it is no package manifest.
    """
    path = folder / MANIFEST
    try:
        root = ElementTree.fromstring(read_regular(path, MOST_BYTES))
    except OSError as error:
        raise InputError(
            f'cannot be read: {error.strerror}', Place(str(path)), 'name the folder of a package'
        ) from None
    except ElementTree.ParseError as error:
        raise InputError(f'no XML: {error}', Place(str(path)), 'mend the file') from None
    return Package(
        folder=folder,
        name=(root.findtext('name') or folder.resolve().name).strip(),
        build_type=(root.findtext('export/build_type') or '').strip(),
        dependencies=frozenset(
            (element.text or '').strip() for element in root if element.tag.endswith('depend')
        ),
    )


def package_name(path: Path) -> str:
    """The package that ``path`` belongs to; without one, the name of the folder."""
    folder = real_path(path) if path.is_dir() else real_path(path).parent
    for candidate in (folder, *folder.parents):
        if DISK.is_file(candidate / MANIFEST):
            try:
                return read_package(candidate).name
            except InputError:
                break
    return folder.name or 'ros2cc'


def python_files(
    paths: Sequence[Path], excludes: Sequence[str] = (), *, on_error: OnError
) -> list[Path]:
    """
    List the Python files that an ament linter looks at.

    :param excludes: shell patterns of file names, or of paths as they are walked.
    :param on_error: called with folders that cannot be read.
    :raises InputError: for a path that is not there.
    """
    found: dict[Path, None] = {}
    for path in paths:
        if not path.exists():
            raise InputError('no such file or directory', Place(str(path)))
        for file in _walk(path, on_error) if path.is_dir() else (path,):
            if not _is_excluded(file, excludes):
                found[file] = None
    return list(found)


def _walk(folder: Path, on_error: OnError) -> Iterator[Path]:
    for base, folders, files in os.walk(folder, onerror=on_error):
        if SKIP_MARKS.intersection((*folders, *files)):
            folders.clear()
            continue
        folders[:] = sorted(name for name in folders if name[0] not in '._')
        yield from (Path(base) / name for name in sorted(files) if name.endswith('.py'))


def _is_excluded(file: Path, excludes: Sequence[str]) -> bool:
    names = (file.name, file.as_posix())
    return any(fnmatchcase(name, pattern) for pattern in excludes for name in names)
