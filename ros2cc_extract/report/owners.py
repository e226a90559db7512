"""Which unit a finding is about, where several programs name a node alike."""

from __future__ import annotations

from collections.abc import Sequence

from ros2cc_extract.findings.model import Finding
from ros2cc_extract.spec.model import Spec


def is_about(finding: Finding, unit: Spec, units: Sequence[Spec]) -> bool:
    """
    Whether ``finding`` is about ``unit``.

    A finding names its unit, and two scripts may well name their nodes alike: then the files that
    the finding shows decide. Where they show none of these programs, each has it.
    """
    if finding.unit != unit.name:
        return False
    shown = {finding.place.file}
    shown.update(remark.place.file for remark in (*finding.chain, *finding.related))
    namesakes = [other for other in units if other.name == unit.name]
    shares = [shown.intersection(other.sources) for other in namesakes]
    return not any(shares) or bool(shown.intersection(unit.sources))
