"""Which rules count where: ``ignore`` and ``per_path`` of ``[tool.ros2cc]``."""

from __future__ import annotations

from collections.abc import Iterable
from fnmatch import fnmatchcase

from ros2cc_extract.findings.base.fingerprints import relative
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.light_dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Selection:
    """
    Rules that are switched off, by codes or the beginnings of codes (``CC4``).

    :param ignore: everywhere.
    :param per_path: in the files that match a shell pattern (``tests/*``), relative to the root.
    """

    ignore: tuple[str, ...] = ()
    per_path: tuple[tuple[str, tuple[str, ...]], ...] = ()


def select(
    findings: Iterable[Finding], selection: Selection, root: str = ''
) -> tuple[Finding, ...]:
    """Keep the findings of rules that count at their place."""
    return tuple(f for f in findings if not _is_off(f, selection, root))


def _is_off(finding: Finding, selection: Selection, root: str) -> bool:
    path = relative(finding.place.file, root)
    switched_off = [
        *selection.ignore,
        *(
            code
            for pattern, codes in selection.per_path
            if fnmatchcase(path, pattern)
            for code in codes
        ),
    ]
    return any(finding.code.startswith(code) for code in switched_off)
