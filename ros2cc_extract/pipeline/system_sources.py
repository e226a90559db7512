"""Launch files among the paths of a check: what they start is scanned in their place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TextIO

from ros2cc_extract.deadline import PATIENT, Patience
from ros2cc_extract.errors import InputError
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.launch.api import is_launch_file
from ros2cc_extract.files import DISK, Files
from ros2cc_extract.pipeline.sources import scan_sources
from ros2cc_extract.pipeline.system import Scanned, scan_system
from ros2cc_extract.source_locations import Place


def launch_files_among(paths: Sequence[Path], files: Files = DISK) -> list[Path]:
    """Those of the paths that are launch files."""
    return [path for path in paths if is_launch_file(path, files)]


def scan_launch_files(
    paths: Sequence[Path],
    arguments: Mapping[str, str],
    stderr: TextIO,
    *,
    cached: bool = True,
    lists_builtin: bool = False,
    files: Files = DISK,
    patience: Patience = PATIENT,
) -> Scanned:
    """
    Scan what launch files start.

    :raises InputError: for a path that is no launch file.
    """
    for path in paths:
        if not files.exists(path):
            raise InputError('no such file or directory', Place(str(path)))
        if not is_launch_file(path, files):
            mend = 'launch files end in .launch.py, .launch.xml or .launch.yaml'
            raise InputError('is no launch file', Place(str(path)), mend)

    def scan(names: Sequence[Path], parameters: Mapping[str, object]) -> Extraction:
        return scan_sources(
            names,
            stderr,
            cached=cached,
            lists_builtin=lists_builtin,
            parameters=parameters,
            files=files,
            patience=patience,
        )

    return scan_system(paths, arguments, scan, files)
