"""The door to what packages install as programs: read from their files, which are never run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.static.packaging.config_files import of_cfg, of_toml
from ros2cc_extract.extract.static.packaging.declarations import Declarations
from ros2cc_extract.extract.static.packaging.setup_py import of_setup_py
from ros2cc_extract.extract.static.program.entry_points import script_files
from ros2cc_extract.files import Files
from ros2cc_extract.source_locations import Place, Unknown

_READERS: dict[str, Callable[[str, str], Declarations]] = {
    'setup.py': of_setup_py,
    'setup.cfg': of_cfg,
    'pyproject.toml': of_toml,
}


def declarations(
    files: Files, folders: Iterable[Path], shown: Callable[[Path], str] = str
) -> Declarations:
    """
    The programs that the packages in ``folders`` declare, in a fixed order.

    :param shown: how a path is shown to the user.
    """
    found = Declarations()
    for path, data in script_files(files, folders):
        found += _READERS[path.name](data.decode(errors='replace'), shown(path))
    return found


def notes_of(unread: Iterable[Unknown]) -> tuple[Diagnostic, ...]:
    """What could not be read, as notes at its places."""
    return tuple(
        Diagnostic(
            severity=Severity.NOTE,
            slug='programs-unread',
            place=why.at or Place(''),
            message=f'programs that this package installs are not all known: {why.reason}',
            help='write the entry points as constants, or name the file that starts the program',
        )
        for why in unread
    )
