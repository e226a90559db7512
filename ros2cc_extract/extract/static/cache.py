"""Results of earlier scans, by the content of every file they depend on."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

from ros2cc_extract.cachefile import code_version, load_value, store_value, tidy
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.project import FollowedFile, Project
from ros2cc_extract.extract.static.source import digest_of
from ros2cc_extract.version import __version__

_SCRIPT_FILES = ('setup.py', 'setup.cfg', 'pyproject.toml')


class ScanCache:
    """The cached result of one scan."""

    def __init__(self, folder: Path, project: Project) -> None:
        self._path = folder / f'{_key(project)}.scan'

    def load(self) -> Extraction | None:
        """The result of a scan of exactly these contents, if there is one."""
        value = load_value(self._path)
        if not isinstance(value, tuple) or len(value) != 2:
            return None
        followed, extraction = value
        if not isinstance(extraction, Extraction):
            return None
        return extraction if _is_current(followed) else None

    def store(self, extraction: Extraction, followed: Iterable[FollowedFile]) -> None:
        """Keep a result."""
        store_value(self._path, (tuple(followed), extraction))
        tidy(self._path.parent)


def _key(project: Project) -> str:
    here = Path(__file__).resolve().parent
    digest = hashlib.sha256(__version__.encode())
    for line in code_version([here, here.parent, here.parents[1] / 'spec']):
        digest.update(line.encode())
    for source in project.given:
        digest.update(f'{source.shown}\0{source.path}\0{source.digest}\n'.encode())
    for path in _script_files(project.script_folders()):
        digest.update(f'{path}\0{digest_of(path.read_bytes())}\n'.encode())
    return digest.hexdigest()


def _script_files(folders: Iterable[Path]) -> Iterable[Path]:
    for folder in sorted(folders):
        for name in _SCRIPT_FILES:
            if (folder / name).is_file():
                yield folder / name


def _is_current(followed: Iterable[FollowedFile]) -> bool:
    try:
        return all(digest_of(Path(name).read_bytes()) == digest for name, digest in followed)
    except OSError:
        return False
