"""The files of the scanned program: which there are, and which one an import names."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.static.source import SourceFile
from ros2cc_extract.extract.static.workspace import home_of
from ros2cc_extract.places import Place

_SKIPPED = frozenset(
    {'__pycache__', 'build', 'install', 'log', 'node_modules', 'venv', '.venv', 'site-packages'}
)
FollowedFile = tuple[str, str]
"""Path and digest of a file."""

_MANIFESTS = ('package.xml', 'setup.py', 'pyproject.toml')
_LEVELS = 5
_NOT_OF_WORKSPACES = sys.stdlib_module_names | {'diagnostic_updater', 'message_filters', 'tf2_ros'}
"""Names never looked for: what the library tables describe is not followed into its sources."""


class Project:
    """
    All files that belong together.

    :param given: the files that the user asked for, by path; others are only followed, and
        found by where they stand alone, so that nothing depends on what was read before.
    :param lists_builtin: whether what rclpy makes for every node is wanted too.
    """

    def __init__(self, root: Path) -> None:
        self._root = root
        self._files: dict[Path, SourceFile] = {}
        self._by_name: dict[str, list[SourceFile]] = {}
        self._by_shown: dict[str, SourceFile] = {}
        self._looked_for: dict[tuple[object, ...], SourceFile | None] = {}
        self._packages: dict[Path, str] = {}
        self._roots: dict[tuple[Path, str], Path | None] = {}
        self.given: list[SourceFile] = []
        self.lists_builtin = False

    @staticmethod
    def of_paths(paths: Sequence[Path], root: Path | None) -> Project:
        """
        Find the Python files under ``paths``.

        :raises InputError: for a missing path, or a directory without any Python file.
        """
        project = Project((root or Path.cwd()).resolve())
        for path in paths:
            project._add_path(path)
        project.given = sorted(dict.fromkeys(project.given), key=lambda source: source.path)
        for source in project.given:
            project._by_name.setdefault(source.module_name, []).append(source)
        return project

    @staticmethod
    def of_text(text: str, name: str) -> Project:
        """A program of one file that is not on the disk."""
        project = Project(Path('/nonexistent'))
        source = SourceFile(Path(name), name, Path(name).stem, '', text, named=True)
        project.given.append(source)
        project._files[Path(name)] = source
        project._by_shown[name] = source
        return project

    @property
    def files(self) -> list[SourceFile]:
        """Every file that was given or followed."""
        return list(self._files.values())

    def shown_as(self, shown: str) -> SourceFile | None:
        """The file that is shown as ``shown``."""
        return self._by_shown.get(shown)

    def script_folders(self) -> set[Path]:
        """Folders that may declare scripts: those above the given files, up to the packages."""
        folders: set[Path] = set()
        for source in self.given:
            if source.given_text is None:
                depth = len(source.package.split('.')) if source.package else 0
                folders.update(list(source.path.parents)[: depth + 2])
        return folders

    def module(self, name: str, importer: str) -> SourceFile | None:
        """The file that ``import name`` means in the file shown as ``importer``."""
        if not name or name.partition('.')[0] == 'rclpy':
            return None
        parts = name.split('.')
        for folder in self._search_folders(importer):
            found = self._in_folder(folder, parts)
            if found is not None:
                return found
        candidates = self._by_name.get(name, [])
        if candidates:
            return candidates[0]
        return self._in_own_package(parts, importer) or self._in_workspace(parts, importer)

    def _in_own_package(self, parts: list[str], importer: str) -> SourceFile | None:
        """A module of the importing file's package, below which folders lack ``__init__.py``."""
        source = self._by_shown.get(importer)
        if parts[0] in _NOT_OF_WORKSPACES or source is None or source.given_text is not None:
            return None
        above = list(source.path.parents)[:_LEVELS]
        top = next((folder for folder in above if folder.name == parts[0]), None)
        return self._in_folder(top.parent, parts) if top is not None else None

    def _in_workspace(self, parts: list[str], importer: str) -> SourceFile | None:
        """A module of another package that stands beside the importing file or above it."""
        source = self._by_shown.get(importer)
        if parts[0] in _NOT_OF_WORKSPACES or source is None or source.given_text is not None:
            return None
        key = (source.path.parent, parts[0])
        if key not in self._roots:
            self._roots[key] = _package_root(*key) or _root_in_repository(*key)
        root = self._roots[key]
        return self._in_folder(root, parts) if root is not None else None

    def _search_folders(self, importer: str) -> Iterator[Path]:
        source = self._by_shown.get(importer)
        if source is None or source.given_text is not None:
            return
        yield source.path.parent
        depth = len(source.package.split('.')) if source.package else 0
        folder = source.path.parent
        for _ in range(depth):
            folder = folder.parent
        if depth:
            yield folder

    def _in_folder(self, folder: Path, parts: list[str]) -> SourceFile | None:
        """The file of a module under ``folder``; looked for once."""
        key = (folder, *parts)
        if key not in self._looked_for:
            self._looked_for[key] = self._look_for(folder, parts)
        return self._looked_for[key]

    def _look_for(self, folder: Path, parts: list[str]) -> SourceFile | None:
        stem = folder.joinpath(*parts)
        for candidate in (stem.with_name(f'{stem.name}.py'), stem / '__init__.py'):
            known = self._files.get(candidate)
            if known is not None:
                return known
            if candidate.is_file():
                return self._add_file(candidate)
        return None

    def followed(self) -> list[FollowedFile]:
        """The files that nobody gave, as they were read."""
        given = {id(source) for source in self.given}
        return [
            (str(source.path), source.digest)
            for source in self._files.values()
            if id(source) not in given
        ]

    def _add_path(self, path: Path) -> None:
        if path.is_dir():
            found = sorted(_python_files(path))
            if not found:
                raise InputError('no Python file in this directory', Place(str(path)))
            self.given.extend(self._add_file(file) for file in found)
        elif path.exists():
            source = self._add_file(path)
            source.named = True
            self.given.append(source)
        else:
            raise InputError('no such file or directory', Place(str(path)))

    def _add_file(self, path: Path) -> SourceFile:
        full = Path(os.path.abspath(path))  # noqa: PTH100  resolve() would follow links
        known = self._files.get(full)
        if known is not None:
            return known
        folder = full.parent
        if folder not in self._packages:
            self._packages[folder] = _package_of(folder)
        package = self._packages[folder]
        stem = full.stem
        name = package if stem == '__init__' and package else f'{package}.{stem}'.lstrip('.')
        source = SourceFile(full, self._shown(path, full), name, package)
        self._files[full] = source
        self._by_shown[source.shown] = source
        return source

    def _shown(self, path: Path, full: Path) -> str:
        try:
            return full.relative_to(self._root).as_posix()
        except ValueError:
            return path.as_posix()


def _package_root(folder: Path, package: str) -> Path | None:
    """
    The folder that holds ``package``, in one of the layouts of ROS packages.

    Only what a manifest stands beside counts, so that no stranger of that name is taken.
    """
    for above in (folder, *list(folder.parents)[:_LEVELS]):
        for home in (above, above / package):
            for root in (home, home / 'src'):
                is_package = (root / package / '__init__.py').is_file()
                if is_package and any((home / name).is_file() for name in _MANIFESTS):
                    return root
    return None


def _root_in_repository(folder: Path, package: str) -> Path | None:
    """The folder that holds ``package``, somewhere else in the same repository."""
    home = home_of(folder, package)
    roots = (home, home / 'src') if home is not None else ()
    return next((r for r in roots if (r / package / '__init__.py').is_file()), None)


def _package_of(folder: Path) -> str:
    names: list[str] = []
    while (folder / '__init__.py').is_file() and folder.name.isidentifier():
        names.append(folder.name)
        folder = folder.parent
    return '.'.join(reversed(names))


def _python_files(folder: Path) -> Iterator[Path]:
    for base, folders, files in os.walk(folder):
        folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))
        for name in files:
            if name.endswith('.py'):
                yield Path(base) / name
