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
    paths: Sequence[Path], *, root: Path | None = None, progress: Progress | None = None
) -> Extraction:
    """
    Scan files and directories; a directory is one program.

    :param root: places are shown relative to it; the current directory by default.
    :param progress: called with the number of files done and of all files.
    :raises InputError: for a missing path, or a directory without any Python file.
    """
    return _scan(Project.of_paths(paths, root), progress)


def scan_text(text: str, name: str = 'node.py') -> Extraction:
    """Scan a program of one file given as text."""
    return _scan(Project.of_text(text, name), None)


def _scan(project: Project, progress: Progress | None) -> Extraction:
    with scanning_limits():
        scripts = console_scripts(project.script_folders())
        units: list[Spec] = []
        noticed: list[Diagnostic] = []
        covered: set[int] = set()
        files = [source for source in project.given if source.mentions_ros]
        for done, source in enumerate(files):
            if progress is not None:
                progress(done, len(files) * 2)
            for entry in entries_of(source, scripts):
                machine = run_entry(project, entry)
                units.extend(specs_of(machine.world, entry.label))
                noticed.extend(machine.world.diagnostics)
                covered.update(_covered(machine.world))
        for done, source in enumerate(files):
            if progress is not None:
                progress(len(files) + done + 1, len(files) * 2)
            rest = run_library(project, source, frozenset(covered))
            if rest is not None:
                units.extend(specs_of(rest.world, None))
                noticed.extend(rest.world.diagnostics)
                covered.update(_covered(rest.world))
    return Extraction(
        units=tuple(units),
        diagnostics=_sorted([*noticed, *(d for file in project.files for d in file.diagnostics)]),
        files_seen=tuple(source.shown for source in project.given),
    )


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
