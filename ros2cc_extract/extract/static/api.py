"""The scanner's door: files in, units and diagnostics out; scanned code is never run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.entries import console_scripts, entries_of
from ros2cc_extract.extract.static.limits import scanning_limits
from ros2cc_extract.extract.static.project import Project
from ros2cc_extract.extract.static.runs import run_entry, run_library
from ros2cc_extract.extract.static.units import specs_of
from ros2cc_extract.extract.static.values import Class
from ros2cc_extract.extract.static.world import World
from ros2cc_extract.spec.model import Spec

Progress = Callable[[int, int], None]


def scan(
    paths: Sequence[Path],
    *,
    root: Path | None = None,
    progress: Progress | None = None,
    cache: Path | None = None,
) -> Extraction:
    """
    Scan files and directories; a directory is one program.

    :param root: places are shown relative to it; the current directory by default.
    :param progress: called with the number of files done and of all files.
    :param cache: folder of earlier results, see ``cache.default_cache_folder``.
    :raises InputError: for a missing path, or a directory without any Python file.
    """
    with scanning_limits():
        project = Project.of_paths(paths, root)
        if cache is None:
            return _scan(project, progress)
        return _scan_cached(project, progress, cache)


def scan_text(text: str, name: str = 'node.py') -> Extraction:
    """Scan a program of one file given as text."""
    with scanning_limits():
        return _scan(Project.of_text(text, name), None)


def _scan_cached(project: Project, progress: Progress | None, folder: Path) -> Extraction:
    # Imported here: most scans go without, and its libraries take longer than a small scan.
    from ros2cc_extract.extract.static.cache import ScanCache

    entry = ScanCache(folder, project)
    known = entry.load()
    if known is None:
        known = _scan(project, progress)
        entry.store(project, known)
    return known


def _scan(project: Project, progress: Progress | None) -> Extraction:
    scanned = _Scan(project, progress)
    scanned.follow_entries()
    scanned.follow_the_rest()
    return scanned.result()


class _Scan:
    """One scan: the programs from their entries, then what no entry reaches."""

    def __init__(self, project: Project, progress: Progress | None) -> None:
        self._project = project
        self._progress = progress or (lambda done, total: None)
        self._files = [source for source in project.given if source.is_scanned]
        self._units: list[list[Spec]] = [[] for _ in self._files]
        self._noticed: list[Diagnostic] = []
        self._covered: set[int] = set()
        self._done = 0

    def follow_entries(self) -> None:
        """Follow every program of the project."""
        scripts = console_scripts(self._project.script_folders())
        for units, source in zip(self._units, self._files, strict=True):
            for entry in entries_of(source, scripts):
                self._keep(run_entry(self._project, entry).world, units, entry.label)
            self._step()

    def follow_the_rest(self) -> None:
        """Follow classes and functions that no entry reaches."""
        for units, source in zip(self._units, self._files, strict=True):
            rest = run_library(self._project, source, frozenset(self._covered))
            if rest is not None:
                self._keep(rest.world, units, None)
            self._step()

    def result(self) -> Extraction:
        """Everything found, in the order of the files."""
        unread = [d for source in self._project.files for d in source.diagnostics]
        return Extraction(
            units=tuple(unit for units in self._units for unit in units),
            diagnostics=_sorted([*self._noticed, *unread]),
            files_seen=tuple(source.shown for source in self._project.given),
        )

    def _keep(self, world: World, units: list[Spec], label: str | None) -> None:
        units.extend(specs_of(world, label))
        self._noticed.extend(world.diagnostics)
        self._covered.update(_covered(world))

    def _step(self) -> None:
        self._done += 1
        self._progress(self._done, 2 * len(self._files))


def _covered(world: World) -> set[int]:
    classes = {
        id(cls.node)
        for instance in world.instances
        for cls in instance.mro
        if isinstance(cls, Class)
    }
    return classes | world.called


def _sorted(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(dict.fromkeys(found), key=lambda d: (d.place, d.slug, d.message)))
