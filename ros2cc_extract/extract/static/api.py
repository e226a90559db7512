"""The scanner's door: files in, units and diagnostics out; scanned code is never run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ros2cc_extract.crew import usable_cores
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.limits import scanning_limits
from ros2cc_extract.extract.static.project import Project
from ros2cc_extract.extract.static.scanning import Progress, scan_project


def scan(
    paths: Sequence[Path],
    *,
    root: Path | None = None,
    progress: Progress | None = None,
    cache: Path | None = None,
    processes: int | None = None,
    lists_builtin: bool = False,
) -> Extraction:
    """
    Scan files and directories; a directory is one program.

    :param root: places are shown relative to it; the current directory by default.
    :param progress: called with the number of files done and of all files.
    :param cache: folder of earlier results, see ``cachefile.default_cache_folder``.
    :param processes: at most so many share the work; by default one for each core.
    :param lists_builtin: also list what rclpy makes by itself for every node; never cached.
    :raises InputError: for a missing path, or a directory without any Python file.
    """
    with scanning_limits():
        project = Project.of_paths(paths, root)
        project.lists_builtin = lists_builtin
        if cache is None or lists_builtin:
            return scan_project(project, usable_cores(processes), progress)[0]
        return _scan_cached(project, progress, cache, usable_cores(processes))


def scan_text(text: str, name: str = 'node.py') -> Extraction:
    """Scan a program of one file given as text."""
    with scanning_limits():
        return scan_project(Project.of_text(text, name), 1, None)[0]


def _scan_cached(
    project: Project, progress: Progress | None, folder: Path, processes: int
) -> Extraction:
    # Imported here: most scans go without, and its libraries take longer than a small scan.
    from ros2cc_extract.extract.static.cache import ScanCache

    entry = ScanCache(folder, project)
    known = entry.load()
    if known is None:
        known, followed = scan_project(project, processes, progress)
        entry.store(known, followed)
    return known
