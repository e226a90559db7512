"""Paths as people read them: relative to where they stand, or to the repository."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.source_locations import Place


@dataclass(frozen=True)
class Paths:
    """
    Folders that shown paths are relative to.

    :param here: the current folder.
    :param root: of the repository; empty if unknown.
    """

    here: Path
    root: str = ''

    def shown(self, file: str) -> str:
        """Give a path without the folders that the reader stands in."""
        path = Path(file)
        if not path.is_absolute():
            return file
        for folder in (self.here, *([Path(self.root)] if self.root else [])):
            if path.is_relative_to(folder):
                return path.relative_to(folder).as_posix()
        return file

    def link(self, file: str) -> str:
        """Give the address of a file, for a terminal to open."""
        return (self.here / file).absolute().as_uri()

    def of(self, place: Place) -> Place:
        """Give a place with the path that is shown."""
        return replace(place, file=self.shown(place.file))

    def remarks(self, finding: Finding) -> Sequence[Remark]:
        """Give the remarks of a finding at shown places, those that lead to it first."""
        remarks = (*finding.chain, *finding.related)
        return [replace(remark, place=self.of(remark.place)) for remark in remarks]
