"""
The systems that paths name: launch files, packages, workspaces, recordings, specifications.

Launch files that are named by themselves are one system. A folder of code gives a system for each
of its launch files; where it has none, one of all programs in it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TextIO

from ros2cc_extract.diagnostics import Diagnostic, unreadable_folder
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.launch.language.recognition import is_launch_file
from ros2cc_extract.files import Files, open_regular
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.program_systems import system_of_programs
from ros2cc_extract.pipeline.sources import RECORDING_SUFFIX, SPEC_SUFFIXES
from ros2cc_extract.pipeline.system import Kept
from ros2cc_extract.pipeline.system_sources import scan_launch_files
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.system.model import System

_SKIPPED = frozenset({'build', 'install', 'log', 'node_modules', 'venv', '__pycache__'})
_MARK = b'"ros2cc live recording"'
_HEAD_BYTES = 2000


@dataclass(frozen=True)
class Side:
    """
    What one path names, or all launch files that are named by themselves.

    :param label: how it is called.
    :param diagnostics: what was noticed on the way.
    """

    label: str
    systems: tuple[System, ...]
    diagnostics: tuple[Diagnostic, ...] = ()

    @property
    def only(self) -> System:
        """
        The one system of it.

        :raises InputError: when there are several.
        """
        if len(self.systems) == 1:
            return self.systems[0]
        names = ', '.join(system.name for system in self.systems[:3])
        what = f'holds {len(self.systems)} systems ({names}{", …" if self.systems[3:] else ""})'
        raise InputError(what, Place(self.label), 'name one launch file')


def names_system(path: Path, files: Files) -> bool:
    """Whether a path can only be a system: no unit, and no source of one."""
    if files.is_folder(path):
        return is_folder_of_recordings(path)
    is_written = path.suffix in SPEC_SUFFIXES and files.is_file(path)
    return is_launch_file(path, files) or (is_written and _is_of_system(path))


def sides_of(
    paths: Sequence[Path],
    arguments: Mapping[str, str],
    stderr: TextIO,
    files: Files,
    *,
    cached: bool = True,
) -> tuple[Side, ...]:
    """
    Read what each path names, in their order; all launch files are one, at the first of them.

    :raises InputError: for a path that names no system.
    """
    launches = [path for path in paths if is_launch_file(path, files)]
    found: list[Side] = []
    for path in paths:
        if path not in launches:
            found.append(_side(path, arguments, stderr, files, cached=cached))
        elif path == launches[0]:
            scanned = scan_launch_files(launches, arguments, stderr, cached=cached, files=files)
            label = ', '.join(map(str, launches))
            found.append(Side(label, (scanned.system,), scanned.extraction.diagnostics))
    return tuple(found)


def _side(
    path: Path, arguments: Mapping[str, str], stderr: TextIO, files: Files, *, cached: bool
) -> Side:
    if files.is_folder(path):
        if is_folder_of_recordings(path):
            return Side(str(path), (_recorded(path, stderr),))
        return _of_folder(path, arguments, stderr, files, cached=cached)
    if path.suffix in SPEC_SUFFIXES and files.is_file(path):
        return _of_specification(path)
    if path.suffix == RECORDING_SUFFIX and files.is_file(path):
        return Side(str(path), (_recorded_file(path),))
    # Says what is wrong with the path.
    scanned = scan_launch_files([path], arguments, stderr, cached=cached, files=files)
    return Side(str(path), (scanned.system,), scanned.extraction.diagnostics)


def is_folder_of_recordings(path: Path) -> bool:
    """Whether a hooked process has written into a folder, as ``collect`` reads it."""
    return any(_is_recording(each) for each in sorted(path.glob(f'*{RECORDING_SUFFIX}'))[:3])


def _is_recording(path: Path) -> bool:
    try:
        with open_regular(path) as stream:
            return _MARK in stream.read(_HEAD_BYTES)
    except OSError:
        return False


def _recorded(path: Path, stderr: TextIO) -> System:
    from ros2cc_extract.extract.live.graph.recorded import recorded_system
    from ros2cc_extract.extract.live.run import read_directory, report_losses

    recordings = read_directory(path, stderr)
    report_losses(recordings, stderr)
    return _with_nodes(recorded_system(recordings, path.name or str(path)), path)


def _recorded_file(path: Path) -> System:
    from ros2cc_extract.extract.live.graph.recorded import recorded_system
    from ros2cc_extract.extract.live.recordings.recording import read_recording

    return _with_nodes(recorded_system([read_recording(path, Path.cwd())], path.name), path)


def _with_nodes(system: System, path: Path) -> System:
    if not system.processes:
        mend = 'let the processes run for a second before they end'
        raise InputError('no recorded process holds a node', Place(str(path)), mend)
    return system


def _is_of_system(path: Path) -> bool:
    from ros2cc_extract.spec.system.system_reading import is_system

    try:
        with open_regular(path) as stream:
            return is_system(stream.read(_HEAD_BYTES).decode(errors='replace'))
    except OSError:
        return False


def _of_specification(path: Path) -> Side:
    from ros2cc_extract.spec.system.system_reading import load_systems

    if not _is_of_system(path):
        mend = 'a system specification is what `system` writes'
        raise InputError('is no system specification', Place(str(path)), mend)
    return Side(str(path), load_systems(path))


def _of_folder(
    path: Path, arguments: Mapping[str, str], stderr: TextIO, files: Files, *, cached: bool
) -> Side:
    barred: list[Diagnostic] = []
    launches = list(launch_files_in(path, files, barred))
    if not launches:
        scanned = system_of_programs(path, stderr, files, cached=cached)
        return Side(str(path), (scanned.system,), scanned.extraction.diagnostics)
    kept = Kept()
    found = [
        scan_launch_files([each], arguments, stderr, cached=cached, files=files, kept=kept)
        for each in launches
    ]
    reported = dict.fromkeys(
        [*barred, *(d for each in found for d in each.extraction.diagnostics)]
    )
    return Side(str(path), tuple(each.system for each in found), tuple(reported))


def launch_files_in(folder: Path, files: Files, barred: list[Diagnostic]) -> Iterator[Path]:
    """
    The launch files below a folder, by path.

    :param barred: gets the folders that could not be looked into.
    """

    def report(error: OSError) -> None:
        barred.append(unreadable_folder(error))

    found: list[Path] = []
    for base, folders, names in files.walk(folder, report):
        folders[:] = sorted(f for f in folders if f not in _SKIPPED and not f.startswith('.'))
        paths: Iterable[Path] = (Path(base) / name for name in sorted(names))
        found += [path for path in paths if is_launch_file(path, files)]
    yield from sorted(found)
