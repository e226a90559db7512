"""What is found in the graph of a whole system, which no unit shows."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.base.rule import Hit, Rule
from ros2cc_extract.findings.rules.systems import near_names, same_node_name, two_types
from ros2cc_extract.spec.system.model import System

_CHECKS: tuple[tuple[Rule, Callable[[System], Iterator[Hit]]], ...] = (
    (near_names.RULE, near_names.find),
    (two_types.RULE, two_types.find),
    (same_node_name.RULE, same_node_name.find),
)


def findings_of_system(system: System) -> tuple[Finding, ...]:
    """The findings of the graph, rule by rule."""
    return tuple(
        Finding(
            code=rule.code,
            severity=hit.severity or rule.severity,
            place=hit.place,
            message=hit.message,
            help=hit.help,
            subjects=hit.subjects,
            related=tuple(dict.fromkeys(hit.related)),
        )
        for rule, find in _CHECKS
        for hit in find(system)
    )
