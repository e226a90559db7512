"""
The files of a repository as a revision has them, beside those of the disk as they are now.

Nothing is written: what a scan asks for is read out of git's objects, so there is no name in a
revision that could lead elsewhere, and nothing to be left behind.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from enum import Enum
from pathlib import Path

from ros2cc_extract.errors import InputError
from ros2cc_extract.files import DISK, OnError, Walked, too_large
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.revision.git import Repository, objects
from ros2cc_extract.source_locations import Place

MOST_ENTRIES = 1_000_000
MOST_LINKS = 40
LONGEST_PATH = 4096
KEPT_BYTES = 8_000_000
"""Of a larger file only its size is used here."""
_MODULES_IN_MODULES = 16
_LINK, _MODULE = '120000', '160000'
_NO_NAMES = frozenset({'', '.', '..', '.git'})
Report = Callable[[str], None]
_READ_AHEAD = ('.py', 'package.xml', 'setup.cfg', 'pyproject.toml')


class Kind(Enum):
    """What stands at a path; a submodule is a folder."""

    FOLDER = 'folder'
    FILE = 'file'
    LINK = 'symbolic link'


@dataclass(frozen=True)
class Entry:
    """
    One entry of a tree.

    :param repository: which has the object called ``name``.
    """

    kind: Kind
    repository: Repository | None = None
    name: str = ''


FOLDER = Entry(Kind.FOLDER)


@dataclass(frozen=True)
class Found:
    """
    What a path leads to.

    :param inner: the path below the top, of an entry of the revision.
    :param outside: the path, where it leads out of the repository.
    """

    inner: str = ''
    entry: Entry | None = None
    outside: Path | None = None


NOTHING = Found()


class Snapshot:
    """
    A revision of the repository whose work tree is at ``top``; see ``files.Files``.

    :param top: absolute, without symbolic links.
    """

    def __init__(self, top: Path, entries: Mapping[str, Entry]) -> None:
        self.top = top
        self._start = f'{top}{os.sep}'.replace('//', '/')
        self._contents: dict[tuple[Repository, str], bytes | int] = {}
        self._folders: dict[str, dict[str, Entry]] = {'': {}}
        for path, entry in entries.items():
            self._add(path, entry)

    @staticmethod
    def of(repository: Repository, top: Path, revision: str, report: Report) -> Snapshot:
        """
        List what a revision holds; submodules as far as they are checked out.

        :param report: takes a line about what is missing.
        :raises InputError: when git cannot say.
        """
        return Snapshot(top, dict(_entries(repository, top, revision, report)))

    def place_of(self, path: Path) -> str | None:
        """
        Give ``path`` below the top; ``None`` where the revision has nothing there.

        :raises InputError: when the repository has no such place.
        """
        found = self._find(path)
        if found.outside is not None:
            what = f'is not in the repository {self.top}, of which a revision is named'
            raise InputError(what, Place(str(path)), 'check it without --diff-base')
        return found.inner if found.entry is not None else None

    def read_ahead(self, paths: Iterable[Path]) -> None:
        """Read in one go what a scan of ``paths`` asks for; the rest is read at first need."""
        starts = [place for place in map(self.place_of, paths) if place is not None]
        wanted: dict[Repository, set[str]] = {}
        for folder, children in self._folders.items():
            for name, entry in children.items():
                path = f'{folder}/{name}'.lstrip('/')
                if entry.repository is not None and (
                    entry.kind is Kind.LINK
                    or (name.endswith(_READ_AHEAD) and _is_below(path, starts))
                ):
                    wanted.setdefault(entry.repository, set()).add(entry.name)
        for repository, names in wanted.items():
            self._read(repository, sorted(names))

    def exists(self, path: Path) -> bool:
        """See ``Files``."""
        found = self._find(path)
        return DISK.exists(found.outside) if found.outside else found.entry is not None

    def is_file(self, path: Path) -> bool:
        """See ``Files``."""
        found = self._find(path)
        if found.outside:
            return DISK.is_file(found.outside)
        return found.entry is not None and found.entry.kind is Kind.FILE

    def is_folder(self, path: Path) -> bool:
        """See ``Files``."""
        found = self._find(path)
        return DISK.is_folder(found.outside) if found.outside else found.entry is FOLDER

    def read(self, path: Path, most_bytes: int) -> bytes:
        """See ``Files``."""
        found = self._find(path)
        if found.outside:
            return DISK.read(found.outside, most_bytes)
        if found.entry is None:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(path))
        if found.entry is FOLDER:
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
        content = self._content(found.entry)
        if isinstance(content, int) or len(content) > most_bytes:
            raise too_large(path, min(most_bytes, KEPT_BYTES))
        return content

    def walk(self, folder: Path, on_error: OnError) -> Iterator[Walked]:
        """See ``Files``."""
        found = self._find(folder)
        if found.outside:
            yield from DISK.walk(found.outside, on_error)
        waiting = [(str(folder), found.inner)] if found.entry is FOLDER else []
        while waiting:
            base, inner = waiting.pop()
            children = self._folders.get(inner, {})
            folders = [name for name in children if self.is_folder(Path(base, name))]
            files = [name for name in children if name not in set(folders)]
            yield base, folders, files
            waiting += [
                (os.path.join(base, name), f'{inner}/{name}'.lstrip('/'))  # noqa: PTH118
                for name in reversed(folders)
                if children[name] is FOLDER
            ]

    def _add(self, path: str, entry: Entry) -> None:
        folder, _, name = path.rpartition('/')
        self._folders.setdefault(folder, {})[name] = entry
        if entry is FOLDER:
            self._folders.setdefault(path, {})
        while folder:
            above, _, name = folder.rpartition('/')
            known = self._folders.setdefault(above, {})
            if known.get(name) is FOLDER:
                return
            known[name] = FOLDER
            folder = above

    def _find(self, path: Path | str, links: int = 0) -> Found:
        """Follow ``path``: through the revision within the repository, on the disk elsewhere."""
        whole = os.path.abspath(path)  # noqa: PTH100  links are followed one by one
        if links == 0 and not f'{whole}/'.startswith(self._start):
            whole = os.path.realpath(whole)
        if not f'{whole}/'.startswith(self._start) or whole.endswith('/.git'):
            return Found(outside=Path(whole))
        at: list[str] = []
        waiting = whole[len(self._start) :].split('/')[::-1]
        while waiting:
            name = waiting.pop()
            if name == '..' and not at:
                return self._follow(self.top.parent, waiting, links)
            if name == '..':
                at.pop()
            if name in ('', '.', '..'):
                continue
            entry = self._folders.get('/'.join(at), {}).get(name)
            if entry is None or (entry.kind is Kind.FILE and waiting):
                return NOTHING
            if entry.kind is not Kind.LINK:
                at.append(name)
                continue
            links += 1
            target = self._target(entry)
            if links > MOST_LINKS or not target:
                return NOTHING
            if target.startswith('/'):
                return self._follow(Path(target), waiting, links)
            waiting += target.split('/')[::-1]
        folder, _, name = '/'.join(at).rpartition('/')
        entry = self._folders[folder][name] if name else FOLDER
        return Found('/'.join(at), entry)

    def _follow(self, start: Path, waiting: list[str], links: int) -> Found:
        """Go on at another place, which may lead back into the repository."""
        if links >= MOST_LINKS:
            return NOTHING
        return self._find(start.joinpath(*reversed(waiting)), links + 1)

    def _target(self, entry: Entry) -> str:
        content = self._content(entry)
        if isinstance(content, int) or len(content) > LONGEST_PATH or b'\0' in content:
            return ''
        return os.fsdecode(content)

    def _content(self, entry: Entry) -> bytes | int:
        assert entry.repository is not None, 'only folders have none'
        if (entry.repository, entry.name) not in self._contents:
            self._read(entry.repository, [entry.name])
        return self._contents[entry.repository, entry.name]

    def _read(self, repository: Repository, names: list[str]) -> None:
        contents = objects(repository, names, KEPT_BYTES)
        for name, content in zip(names, contents, strict=True):
            self._contents[repository, name] = content


def _is_below(path: str, starts: Iterable[str]) -> bool:
    return any(not start or path == start or path.startswith(f'{start}/') for start in starts)


def _entries(
    repository: Repository,
    folder: Path,
    revision: str,
    report: Report,
    above: tuple[str, ...] = (),
) -> Iterator[tuple[str, Entry]]:
    """
    Path and entry of everything, but of what has a name that no work tree can hold.

    :param above: the submodules within which this one is.
    """
    listing = repository.ask('ls-tree', '-r', '-z', '--full-tree', revision).split(b'\0')
    if len(listing) > MOST_ENTRIES:
        raise InputError(f'{revision} has more than {MOST_ENTRIES:,} files', None, '')
    for line in listing:
        head, _, name = line.partition(b'\t')
        path = '/'.join((*above, os.fsdecode(name)))
        if not name or len(path) > LONGEST_PATH or not _NO_NAMES.isdisjoint(path.split('/')):
            continue
        mode, _, object_name = head.decode().split()
        if mode != _MODULE:
            kind = Kind.LINK if mode == _LINK else Kind.FILE
            yield path, Entry(kind, repository, object_name)
            continue
        yield path, FOLDER
        inner = folder / os.fsdecode(name)
        if len(above) < _MODULES_IN_MODULES and _is_checked_out(inner):
            if Repository(inner).try_to_ask('cat-file', '-e', f'{object_name}^{{commit}}').status:
                report(f'submodule {path} has no {object_name[:12]}: what is in it counts as new')
            else:
                yield from _entries(Repository(inner), inner, object_name, report, (path,))


def _is_checked_out(module: Path) -> bool:
    """Whether a submodule has a work tree of its own, and not by a link elsewhere."""
    return (module / '.git').exists() and os.path.realpath(module) == str(module)
