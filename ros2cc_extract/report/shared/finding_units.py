"""Which unit a finding is about, where several programs name a node alike."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.source_locations import Unknown
from ros2cc_extract.spec.model import Spec


def is_about(finding: Finding, unit: Spec, units: Sequence[Spec]) -> bool:
    """
    Whether ``finding`` is about ``unit``.

    A finding names its unit, and two scripts may well name their nodes alike: then the files that
    the finding shows decide, and of programs of the same files those whose executor is known.
    Where they show none of these programs, each has it.
    """
    if finding.unit != unit.name:
        return False
    shown = {finding.place.file}
    shown.update(remark.place.file for remark in (*finding.chain, *finding.related))
    namesakes = [other for other in units if other.name == unit.name]
    of_files = [other for other in namesakes if shown.intersection(other.sources)] or namesakes
    spun = [other for other in of_files if not isinstance(other.executor.kind, Unknown)]
    return any(other is unit for other in spun or of_files)
