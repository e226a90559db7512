"""The one door to findings: from units, verdicts and diagnostics to a sorted list."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.model import Finding
from ros2cc_extract.findings.registry import BY_SLUG, RULES
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.findings.rules.of_diagnostics import UNREADABLE
from ros2cc_extract.findings.rules.unresolved import RULE as UNRESOLVED
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify import Verification


def findings_of(
    units: Sequence[Spec],
    diagnostics: Iterable[Diagnostic],
    verifications: Sequence[Verification | None] = (),
) -> tuple[Finding, ...]:
    """
    All findings, by place and then by code; the order of the units does not matter.

    :param verifications: of the units, in their order; empty when none was verified.
    """
    verdicts = verifications or [None] * len(units)
    found = [
        *(_of_diagnostic(diagnostic) for diagnostic in diagnostics),
        *(
            finding
            for unit, verification in zip(units, verdicts, strict=True)
            for finding in _of_unit(Context(unit, verification))
        ),
    ]
    by_identity = {(f.place, f.code, f.message, f.unit or ''): f for f in found}
    alike: dict[tuple[object, ...], Finding] = {}
    for identity in sorted(by_identity):
        alike.setdefault(identity[:3], by_identity[identity])
    return tuple(alike.values())


def _of_unit(context: Context) -> Iterator[Finding]:
    for rule in RULES:
        yield from rule.check(context)


def _of_diagnostic(diagnostic: Diagnostic) -> Finding:
    fallback = UNRESOLVED if diagnostic.severity is Severity.NOTE else UNREADABLE
    rule = BY_SLUG.get(diagnostic.slug, fallback)
    return Finding(
        code=rule.code,
        severity=diagnostic.severity,
        place=diagnostic.place,
        message=diagnostic.message,
        help=diagnostic.help,
    )
