"""The scanner's door: files in, units and diagnostics out; scanned code is never run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ros2cc_extract.deadline import PATIENT, Patience
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.program.given_parameters import NONE_GIVEN, GivenParameters
from ros2cc_extract.extract.static.program.project import FollowedFile, Project
from ros2cc_extract.extract.static.program.runtime_limits import scanning_limits
from ros2cc_extract.files import DISK, Files
from ros2cc_extract.jobs.process_pool import usable_cores

if TYPE_CHECKING:
    from ros2cc_extract.extract.static.scan.scanning import Progress


def scan(
    paths: Sequence[Path],
    *,
    root: Path | None = None,
    progress: Progress | None = None,
    cache: Path | None = None,
    processes: int | None = None,
    lists_builtin: bool = False,
    parameters: GivenParameters = NONE_GIVEN,
    files: Files = DISK,
    patience: Patience = PATIENT,
) -> Extraction:
    """
    Scan files and directories; a directory is one program.

    :param root: places are shown relative to it; the current directory by default.
    :param progress: called with the number of files done and of all files.
    :param cache: folder of earlier results, see ``cache_file.default_cache_folder``.
    :param processes: at most so many share the work; by default one for each core.
    :param lists_builtin: also list what rclpy makes by itself for every node; never cached.
    :param parameters: what a launch sets for the nodes.
    :param files: those of the disk, or of another revision.
    :param patience: when to end before all is followed.
    :raises InputError: for a missing path, or a directory without any Python file.
    """
    with scanning_limits():
        project = Project.of_paths(paths, root, files)
        project.lists_builtin = lists_builtin
        project.deadline = patience.deadline
        project.parameters = parameters
        if cache is None or lists_builtin:
            return _scanned(project, usable_cores(processes), progress, patience)[0]
        return _scan_cached(project, progress, cache, usable_cores(processes), patience)


def scan_text(text: str, name: str = 'node.py') -> Extraction:
    """Scan a program of one file given as text."""
    with scanning_limits():
        return _scanned(Project.of_text(text, name), 1, None, PATIENT)[0]


def _scanned(
    project: Project, processes: int, progress: Progress | None, patience: Patience
) -> tuple[Extraction, frozenset[FollowedFile]]:
    # Imported here: what the cache knows is returned without the interpreter, which loads slowly.
    from ros2cc_extract.extract.static.scan.scanning import scan_project

    return scan_project(project, processes, progress, patience)


def _scan_cached(
    project: Project,
    progress: Progress | None,
    folder: Path,
    processes: int,
    patience: Patience,
) -> Extraction:
    # Imported here: most scans go without, and its libraries take longer than a small scan.
    from ros2cc_extract.extract.static.program.scan_cache import ScanCache

    entry = ScanCache(folder, project)
    known = entry.load()
    if known is None:
        known, followed = _scanned(project, processes, progress, patience)
        if not known.cut:
            entry.store(known, followed)
    return known
