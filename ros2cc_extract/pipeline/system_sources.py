"""Launch files among the paths of a check: what they start is scanned in their place."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from ros2cc_extract.deadline import PATIENT, Patience
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.launch.language.recognition import is_launch_file
from ros2cc_extract.extract.static.program.given_parameters import GivenParameters
from ros2cc_extract.files import DISK, Files
from ros2cc_extract.pipeline.sources import scan_sources
from ros2cc_extract.source_locations import Place

_ARGUMENT = re.compile(r'([A-Za-z_]\w*):=(.*)', re.DOTALL)

# A check of files alone, which most are, loads nothing of launch files.
if TYPE_CHECKING:
    from ros2cc_extract.pipeline.system import Kept, Scanned
    from ros2cc_extract.spec.system.model import System


def divided(words: Sequence[str]) -> tuple[list[Path], dict[str, str]]:
    """Paths and ``name:=value`` of a command line."""
    paths, arguments = [], {}
    for word in words:
        match = _ARGUMENT.fullmatch(word)
        if match is not None:
            arguments[match.group(1)] = match.group(2)
        else:
            paths.append(Path(word))
    return paths, arguments


def names_launch_file(path: Path) -> bool:
    """Whether a path of the command line is a launch file."""
    return is_launch_file(path, DISK)


def scan_paths(
    paths: Sequence[Path],
    arguments: Mapping[str, str],
    stderr: TextIO,
    *,
    cached: bool = True,
    lists_builtin: bool = False,
    files: Files = DISK,
    patience: Patience = PATIENT,
) -> tuple[Extraction, System | None]:
    """
    Scan files and folders; of launch files what they start, as one system.

    :raises InputError: for an argument without a launch file that takes it.
    """
    launches = [path for path in paths if is_launch_file(path, files)]
    others = [path for path in paths if path not in launches]

    def scan() -> Extraction:
        return scan_sources(
            others,
            stderr,
            cached=cached,
            lists_builtin=lists_builtin,
            files=files,
            patience=patience,
        )

    if not launches:
        if arguments:
            name = next(iter(arguments))
            raise InputError(f'{name}:= is for a launch file', None, 'name the launch file too')
        return scan(), None
    scanned = scan_launch_files(
        launches,
        arguments,
        stderr,
        cached=cached,
        lists_builtin=lists_builtin,
        files=files,
        patience=patience,
    )
    started = _with_circles(scanned)
    return _as_one([started, scan()] if others else [started]), scanned.system


def _with_circles(scanned: Scanned) -> Extraction:
    """Circles of processes are decided as one unit each."""
    from ros2cc_extract.spec.system.circles.joined_processes import circles_of

    started = scanned.extraction
    return replace(started, joined=(*started.joined, *circles_of(scanned.system).joined))


def _as_one(found: Sequence[Extraction]) -> Extraction:
    from ros2cc_extract.pipeline.system import as_one

    return found[0] if len(found) == 1 else as_one(found)


def scan_launch_files(
    paths: Sequence[Path],
    arguments: Mapping[str, str],
    stderr: TextIO,
    *,
    cached: bool = True,
    lists_builtin: bool = False,
    files: Files = DISK,
    patience: Patience = PATIENT,
    kept: Kept | None = None,
) -> Scanned:
    """
    Scan what launch files start.

    :param kept: what other systems of the same workspace have left.
    :raises InputError: for a path that is no launch file.
    """
    for path in paths:
        if not files.exists(path):
            raise InputError('no such file or directory', Place(str(path)))
        if not is_launch_file(path, files):
            mend = 'launch files end in .launch.py, .launch.xml or .launch.yaml'
            raise InputError('is no launch file', Place(str(path)), mend)

    def scan(names: Sequence[Path], parameters: GivenParameters) -> Extraction:
        return scan_sources(
            names,
            stderr,
            cached=cached,
            lists_builtin=lists_builtin,
            parameters=parameters,
            files=files,
            patience=patience,
        )

    from ros2cc_extract.pipeline.system import scan_system

    return scan_system(paths, arguments, scan, files, kept)
