"""From what the extractor noticed to findings with a code."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.model import Finding
from ros2cc_extract.places import Place
from ros2cc_extract.spec.model import Spec

UNRESOLVED_CODE = 'CC501'
CODES = {
    'executor-not-spun': 'CC405',
}
UNREADABLE_CODE = 'CC500'


def findings_of(units: Iterable[Spec], diagnostics: Iterable[Diagnostic]) -> tuple[Finding, ...]:
    """All findings, by place and then by code; the order of the units does not matter."""
    found = [
        *(_of_diagnostic(diagnostic) for diagnostic in diagnostics),
        *(finding for unit in units for finding in _unresolved(unit)),
    ]
    by_identity = {(f.place, f.code, f.message): f for f in found}
    return tuple(by_identity[identity] for identity in sorted(by_identity))


def _of_diagnostic(diagnostic: Diagnostic) -> Finding:
    fallback = UNRESOLVED_CODE if diagnostic.severity is Severity.NOTE else UNREADABLE_CODE
    return Finding(
        code=CODES.get(diagnostic.slug, fallback),
        severity=diagnostic.severity,
        place=diagnostic.place,
        message=diagnostic.message,
        help=diagnostic.help,
    )


def _unresolved(unit: Spec) -> Iterator[Finding]:
    for fact in unit.unresolved:
        yield Finding(
            code=UNRESOLVED_CODE,
            severity=Severity.NOTE,
            place=fact.source or Place(unit.sources[0] if unit.sources else unit.name),
            message=f'{fact.fact} of {fact.subject} not resolved: {fact.reason}',
            unit=unit.name,
            subjects=(fact.subject,),
        )
