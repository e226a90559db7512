"""
Results of earlier scans, by the content of every file they depend on.

The folder belongs to the user and is written by this tool alone; a damaged or foreign entry
counts as none.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import tempfile
from collections.abc import Iterable
from pathlib import Path

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.project import Project
from ros2cc_extract.version import __version__

_SCRIPT_FILES = ('setup.py', 'setup.cfg', 'pyproject.toml')
_UNREADABLE = (OSError, pickle.UnpicklingError, EOFError, AttributeError, ImportError, ValueError)


def default_cache_folder() -> Path:
    """The tool's folder in the user's cache (XDG base directory specification)."""
    base = os.environ.get('XDG_CACHE_HOME')
    return (Path(base) if base else Path.home() / '.cache') / 'ros2cc-extract'


class ScanCache:
    """The cached results in one folder."""

    def __init__(self, folder: Path, project: Project) -> None:
        self._path = folder / f'{_key(project)}.scan'

    def load(self) -> Extraction | None:
        """The result of a scan of exactly these contents, if there is one."""
        try:
            followed, extraction = pickle.loads(self._path.read_bytes())
        except _UNREADABLE:
            return None
        if not isinstance(extraction, Extraction):
            return None
        return extraction if _is_current(followed) else None

    def store(self, project: Project, extraction: Extraction) -> None:
        """Keep a result; a folder that cannot be written is no error."""
        given = {id(source) for source in project.given}
        followed = [
            (str(source.path), _digest(source.data))
            for source in project.files
            if id(source) not in given
        ]
        try:
            self._path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            handle, name = tempfile.mkstemp(dir=self._path.parent)
            with os.fdopen(handle, 'wb') as stream:
                pickle.dump((followed, extraction), stream)
            Path(name).replace(self._path)
        except OSError:
            return


def _key(project: Project) -> str:
    digest = hashlib.sha256(__version__.encode())
    for line in _own_files():
        digest.update(line.encode())
    for source in project.given:
        digest.update(f'{source.shown}\0{source.path}\0{_digest(source.data)}\n'.encode())
    for path in _script_files(project.script_folders()):
        digest.update(f'{path}\0{_digest(path.read_bytes())}\n'.encode())
    return digest.hexdigest()


def _own_files() -> Iterable[str]:
    """The scanner's own files and those of its values: another version may say something else."""
    here = Path(__file__).resolve().parent
    for folder in (here, here.parent, here.parents[1] / 'spec'):
        for path in sorted(folder.glob('*.py')):
            status = path.stat()
            yield f'{folder.name}/{path.name} {status.st_size} {status.st_mtime_ns}'


def _script_files(folders: Iterable[Path]) -> Iterable[Path]:
    for folder in sorted(folders):
        for name in _SCRIPT_FILES:
            if (folder / name).is_file():
                yield folder / name


def _is_current(followed: list[tuple[str, str]]) -> bool:
    try:
        return all(_digest(Path(name).read_bytes()) == digest for name, digest in followed)
    except OSError:
        return False


def _digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=16).hexdigest()
