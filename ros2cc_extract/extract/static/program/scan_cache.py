"""Results of earlier scans, by the content of every file they depend on."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

from ros2cc_extract.cache_file import load_value, store_value, tidy, tool_version
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.program.entry_points import script_files
from ros2cc_extract.extract.static.program.project import FollowedFile, Project
from ros2cc_extract.extract.static.program.source import SIZE_LIMIT_BYTES, digest_of
from ros2cc_extract.files import Files
from ros2cc_extract.plain_data import Packer

Kept = tuple[tuple[FollowedFile, ...], Extraction]
_KEPT: Packer[Kept] = Packer(Kept)


class ScanCache:
    """The cached result of one scan."""

    def __init__(self, folder: Path, project: Project) -> None:
        self._files = project.disk
        self._path = folder / f'{_key(project)}.scan'

    def load(self) -> Extraction | None:
        """The result of a scan of exactly these contents, if there is one."""
        kept = load_value(self._path, _KEPT)
        if kept is None:
            return None
        followed, extraction = kept
        return extraction if _is_current(self._files, followed) else None

    def store(self, extraction: Extraction, followed: Iterable[FollowedFile]) -> None:
        """Keep a result."""
        store_value(self._path, (tuple(followed), extraction), _KEPT)
        tidy(self._path.parent)


def _key(project: Project) -> str:
    digest = hashlib.sha256(tool_version().encode())
    for source in project.given:
        asked = source.named  # one that was named is always read
        digest.update(_bytes(f'{source.shown}\0{source.path}\0{source.digest}\0{asked}\n'))
    for path, data in script_files(project.disk, project.script_folders()):
        digest.update(_bytes(f'{path}\0{digest_of(data)}\n'))
    digest.update(_bytes(project.parameters.key))
    for barred in project.barred:
        digest.update(_bytes(f'{barred.place} {barred.message}\n'))
    return digest.hexdigest()


def _bytes(text: str) -> bytes:
    return text.encode('utf-8', 'surrogatepass')  # of names that are no UTF-8


def _is_current(files: Files, followed: Iterable[FollowedFile]) -> bool:
    try:
        return all(
            digest_of(files.read(Path(name), SIZE_LIMIT_BYTES)) == digest
            for name, digest in followed
        )
    except OSError:
        return False
