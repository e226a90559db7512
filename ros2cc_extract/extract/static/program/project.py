"""The files of the scanned program: which there are, and which one an import names."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from ros2cc_extract.deadline import Deadline
from ros2cc_extract.diagnostics import Diagnostic, unreadable_folder
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.static.program.given_parameters import NONE_GIVEN
from ros2cc_extract.extract.static.program.source import SourceFile
from ros2cc_extract.extract.static.program.workspace import home_of
from ros2cc_extract.files import DISK, Files, OnError
from ros2cc_extract.source_locations import Place, shown_name

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
    :ivar parameters: what a launch sets for the nodes.
    :ivar deadline: when to end before all is followed.
    :ivar disk: where files are looked for.
    :ivar barred: folders that could not be looked into.
    """

    def __init__(self, root: Path, files: Files = DISK) -> None:
        self._root = root
        self.disk = files
        self.barred: list[Diagnostic] = []
        self._files: dict[Path, SourceFile] = {}
        self._by_name: dict[str, list[SourceFile]] = {}
        self._by_shown: dict[str, SourceFile] = {}
        self._looked_for: dict[tuple[object, ...], SourceFile | None] = {}
        self._packages: dict[Path, str] = {}
        self._roots: dict[tuple[Path, str], Path | None] = {}
        self.given: list[SourceFile] = []
        self.lists_builtin = False
        self.parameters = NONE_GIVEN
        self.deadline: Deadline | None = None

    @staticmethod
    def of_paths(paths: Sequence[Path], root: Path | None, files: Files = DISK) -> Project:
        """
        Find the Python files under ``paths``.

        :raises InputError: for a missing path, or a directory without any Python file.
        """
        project = Project((root or Path.cwd()).resolve(), files)
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
            here = self.disk
            root = _package_root(here, *key) or _root_in_repository(here, *key)
            self._roots[key] = root or _namespace_root(here, *key)
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
            if self.disk.is_file(candidate):
                return self._add_file(candidate)
        return None

    def followed(self) -> list[FollowedFile]:
        """The files that were not given, as they were read."""
        given = {id(source) for source in self.given}
        return [
            (str(source.path), source.digest)
            for source in self._files.values()
            if id(source) not in given
        ]

    def _add_path(self, path: Path) -> None:
        if self.disk.is_folder(path):
            barred = len(self.barred)
            found = sorted(python_files(self.disk, path, self._report_barred))
            if not found and len(self.barred) == barred:
                raise InputError('no Python file in this directory', Place(str(path)))
            self.given.extend(self._add_file(file) for file in found)
        elif self.disk.exists(path):
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
            self._packages[folder] = _package_of(self.disk, folder)
        package = self._packages[folder]
        stem = shown_name(full.stem)
        name = package if stem == '__init__' and package else f'{package}.{stem}'.lstrip('.')
        source = SourceFile(full, self._shown(path, full), name, package, files=self.disk)
        self._files[full] = source
        self._by_shown[source.shown] = source
        return source

    def _report_barred(self, error: OSError) -> None:
        path = Path(os.fsdecode(error.filename))
        shown = self._shown(path, Path(os.path.abspath(path)))  # noqa: PTH100
        self.barred.append(unreadable_folder(error, shown))

    def shown(self, path: Path) -> str:
        """A path as it is shown to the user."""
        return self._shown(path, Path(os.path.abspath(path)))  # noqa: PTH100

    def _shown(self, path: Path, full: Path) -> str:
        is_below = full.is_relative_to(self._root)
        return shown_name((full.relative_to(self._root) if is_below else path).as_posix())


def _package_root(files: Files, folder: Path, package: str) -> Path | None:
    """
    The folder that holds ``package``, in one of the layouts of ROS packages.

    Only what a manifest stands beside counts, so that no stranger of that name is taken.
    """
    for above in (folder, *list(folder.parents)[:_LEVELS]):
        for home in (above, above / package):
            for root in (home, home / 'src'):
                is_package = files.is_file(root / package / '__init__.py')
                if is_package and any(files.is_file(home / name) for name in _MANIFESTS):
                    return root
    return None


def _namespace_root(files: Files, folder: Path, package: str) -> Path | None:
    """The folder beside the manifest of the importing file that holds ``package`` (PEP 420)."""
    for home in (folder, *list(folder.parents)[:_LEVELS]):
        if any(files.is_file(home / name) for name in _MANIFESTS):
            roots = (home, home / 'src')
            return next((root for root in roots if files.is_folder(root / package)), None)
    return None


def _root_in_repository(files: Files, folder: Path, package: str) -> Path | None:
    """The folder that holds ``package``, somewhere else in the same repository."""
    home = home_of(files, folder, package)
    roots = (home, home / 'src') if home is not None else ()
    return next((r for r in roots if files.is_file(r / package / '__init__.py')), None)


def _package_of(files: Files, folder: Path) -> str:
    names: list[str] = []
    while files.is_file(folder / '__init__.py') and folder.name.isidentifier():
        names.append(folder.name)
        folder = folder.parent
    return '.'.join(reversed(names))


def python_files(files: Files, folder: Path, on_error: OnError) -> Iterator[Path]:
    """The Python files that are scanned if ``folder`` is given."""
    for base, folders, names in files.walk(folder, on_error):
        folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))
        for name in names:
            if name.endswith('.py'):
                yield Path(base) / name
