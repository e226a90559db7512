"""
The packages of a workspace, and the executables that they install.

Sources: colcon (a package is a folder with a ``package.xml``); ament_cmake and ament_python (what
is installed to ``lib/PACKAGE`` is an executable of the package); setuptools (``console_scripts``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path

from ros2cc_extract.extract.launch.workspace.cmake import installed_programs, targets_of
from ros2cc_extract.extract.static.packaging.api import declarations
from ros2cc_extract.extract.static.packaging.declarations import Declarations
from ros2cc_extract.files import Files
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Unknown

_MANIFEST = 'package.xml'
_NAME = re.compile(r'<name>\s*([\w.\-]+)\s*</name>')
_SKIPPED = frozenset({'build', 'log', 'node_modules', 'venv', '__pycache__'})
_LEVELS, _DEPTH = 6, 6
_MOST_FOLDERS = 20_000
MOST_BYTES = 1_000_000
Known = dict[Path, dict[str, Path]]


@dataclass(frozen=True)
class Executable:
    """
    What an executable is.

    :param file: the Python file that it runs; ``None`` where it is no Python.
    :param function: which function of it; ``None`` where the file is run as a script.
    """

    file: Path | None
    function: str | None = None


class Packages:
    """
    The packages around a launch file.

    :param start: the launch file.
    :param shown: how a path is shown to the user.
    :param known: packages by the folder below which they were looked for, which this adds to.
    """

    def __init__(
        self,
        files: Files,
        start: Path,
        shown: Callable[[Path], str] = lambda path: str(path),
        known: Known | None = None,
    ) -> None:
        self._files = files
        self._shown = shown
        self._declared: dict[Path, Declarations] = {}
        own, root = _root(files, start.absolute().parent)
        known = {} if known is None else known
        if root not in known:
            known[root] = dict(self._search(root))
        self._found = dict(known[root])
        if own is not None:
            self._found[self._name_of(own)] = own

    def folder(self, name: str) -> Path | None:
        """The folder of a package; what it shares stands there as in its share folder."""
        return self._found.get(name)

    def executable(self, package: str, name: str) -> Executable | None:
        """What ``ros2 run PACKAGE NAME`` runs; ``None`` where that is not known."""
        folder = self._found.get(package)
        if folder is None:
            return None
        found = (
            self._console_script(folder, name)
            or self._script(folder, name)
            or self._program(folder, name)
            or self._installed(folder, package, name)
        )
        return found or self._target(folder, name)

    def text(self, path: Path) -> str:
        """A file as text, empty where it cannot be read."""
        return self.content(path) or ''

    def content(self, path: Path) -> str | None:
        """A file as text, ``None`` where it cannot be read."""
        try:
            return self._files.read(path, MOST_BYTES).decode(errors='replace')
        except (OSError, ValueError):
            return None

    def has(self, path: Path) -> bool:
        """Whether a file is there."""
        return self._files.is_file(path)

    def _search(self, root: Path) -> Iterator[tuple[str, Path]]:
        walked = self._files.walk(root, lambda error: None)
        for seen, (base, folders, names) in enumerate(walked):
            here = Path(base)
            if _MANIFEST in names:
                yield self._name_of(here), here
            is_deep = len(here.relative_to(root).parts) >= _DEPTH
            is_package = _MANIFEST in names and here != root
            if is_deep or is_package or seen > _MOST_FOLDERS:
                folders.clear()
            folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))

    def _name_of(self, folder: Path) -> str:
        match = _NAME.search(self.text(folder / _MANIFEST))
        return match.group(1) if match else folder.name

    def declared(self, folder: Path) -> Declarations:
        """What the package in ``folder`` says that it installs; read once."""
        if folder not in self._declared:
            self._declared[folder] = declarations(self._files, [folder], self._shown)
        return self._declared[folder]

    def unread(self, package: str) -> tuple[Unknown, ...]:
        """Why a package may install more programs than are known."""
        folder = self._found.get(package)
        return () if folder is None else self.declared(folder).unread

    def _console_script(self, folder: Path, name: str) -> Executable | None:
        for script in self.declared(folder).scripts:
            file = self._module(folder, script.module) if script.name == name else None
            if file is not None:
                return Executable(file, script.function)
        return None

    def _module(self, folder: Path, name: str) -> Path | None:
        for root in (folder, folder / 'src'):
            stem = root.joinpath(*name.split('.'))
            for file in (stem.with_name(f'{stem.name}.py'), stem / '__init__.py'):
                if self._files.is_file(file):
                    return file
        return None

    def _script(self, folder: Path, name: str) -> Executable | None:
        """``scripts`` and ``data_files`` of ``setup.py``: files by their names."""
        for program in self.declared(folder).programs:
            if program.name == name and self._files.is_file(folder / program.path):
                return self._as_python(folder / program.path)
        return None

    def _program(self, folder: Path, name: str) -> Executable | None:
        """``install(PROGRAMS …)`` of ``CMakeLists.txt``, of a folder as a whole too."""
        for path, installed in installed_programs(self.text(folder / 'CMakeLists.txt')):
            if path.endswith('/'):
                file = folder / path / name
                if self._files.is_file(file):
                    return self._as_python(file)
            elif installed == name and self._files.is_file(folder / path):
                return self._as_python(folder / path)
        return None

    def _installed(self, folder: Path, package: str, name: str) -> Executable | None:
        """Of an installed package, ``lib/PACKAGE/NAME`` beside its share folder."""
        if folder.parent.name != 'share':
            return None
        file = folder.parents[1] / 'lib' / package / name
        return self._as_python(file) if self._files.is_file(file) else None

    def _target(self, folder: Path, name: str) -> Executable | None:
        """A program that CMake builds, which is no Python."""
        is_built = name in targets_of(self.text(folder / 'CMakeLists.txt'))
        return Executable(None) if is_built else None

    def _as_python(self, file: Path) -> Executable:
        is_python = file.suffix == '.py' or 'python' in self.text(file)[:200].partition('\n')[0]
        return Executable(file if is_python else None)


def _root(files: Files, folder: Path) -> tuple[Path | None, Path]:
    """The package of the launch file; the repository, else the workspace, else what is beside."""
    above = [folder, *list(folder.parents)[:_LEVELS]]
    package = next((each for each in above if files.is_file(each / _MANIFEST)), None)
    for each in above:
        if files.exists(each / '.git') or each.name == 'src' or each.name == 'share':
            return package, each
    return package, package.parent if package is not None else folder
