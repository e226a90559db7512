"""A folder without launch files as a system: one process for each start of a program."""

from __future__ import annotations

from pathlib import Path
from typing import TextIO

from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.files import Files
from ros2cc_extract.pipeline.sources import scan_sources
from ros2cc_extract.pipeline.system import Scanned, unresolved_of
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.system.launched import ENTRY, Launched
from ros2cc_extract.spec.system.model import Process, System
from ros2cc_extract.spec.system.nodes import system_node


def system_of_programs(
    folder: Path, stderr: TextIO, files: Files, *, cached: bool = True
) -> Scanned:
    """
    Scan a folder; each start of a program is a process, without remaps or parameters.

    :raises InputError: when there is no Python file in it.
    """
    found = scan_sources([folder], stderr, cached=cached, files=files)
    processes = _processes(found)
    system = System(
        name=folder.name or str(folder),
        processes=processes,
        unresolved=tuple(unresolved_of(processes, ())),
    )
    return Scanned(system, found, ())


def _processes(found: Extraction) -> tuple[Process, ...]:
    starts = [*(unit.entry for unit in found.units), *(node.entry for node in found.nodes)]
    names = _names([entry for entry in dict.fromkeys(starts) if entry is not None])
    return tuple(_process(entry, name, found) for entry, name in names.items())


def _process(entry: str, name: str, found: Extraction) -> Process:
    file = entry.rpartition(':')[0]
    launched = Launched(kind=ENTRY, source=Place(file))
    nodes = [node for node in found.nodes if node.entry == entry]
    known = [node for node in nodes if isinstance(node.name, str)] or nodes
    return Process(
        name=name,
        launched=launched,
        file=file,
        entry=entry,
        nodes=tuple(system_node(node, launched) for node in known),
        units=tuple(unit for unit in found.units if unit.entry == entry),
    )


def _names(entries: list[str]) -> dict[str, str]:
    """A name for each start: of its file, with a number where that is taken."""
    taken: dict[str, int] = {}
    found: dict[str, str] = {}
    for entry in sorted(entries):
        file, _, function = entry.rpartition(':')
        stem = file.rpartition('/')[2].removesuffix('.py')
        name = stem if function in ('main', '__main__') else f'{stem}.{function}'
        number = taken[name] = taken.get(name, 0) + 1
        found[entry] = name if number == 1 else f'{name}_{number}'
    return found
