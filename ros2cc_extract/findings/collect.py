"""The one door to findings: from units, verdicts and diagnostics to a sorted list."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.model import Finding
from ros2cc_extract.findings.registry import BY_SLUG, RULES
from ros2cc_extract.findings.rule import Context
from ros2cc_extract.findings.rules.of_diagnostics import UNREADABLE
from ros2cc_extract.findings.rules.unresolved import RULE as UNRESOLVED
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.releases import has_change
from ros2cc_extract.verify.unit import Verification


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
    pairs = zip(units, verdicts, strict=True)
    releases = {unit.rclpy for unit in units}
    return all_findings([findings_of_unit(*pair) for pair in pairs], diagnostics, releases)


def all_findings(
    by_unit: Iterable[Iterable[Finding]],
    diagnostics: Iterable[Diagnostic],
    releases: Collection[str | None] = (),
) -> tuple[Finding, ...]:
    """
    The findings of several units and of the scan as one list, each once.

    :param releases: of rclpy, which the units name.
    """
    found = [
        *(
            _of_diagnostic(diagnostic, matters)
            for diagnostic in diagnostics
            if (matters := _matters(diagnostic, releases)) is not False
        ),
        *(finding for findings in by_unit for finding in findings),
    ]
    by_identity = {_identity(finding): finding for finding in found}
    alike: dict[tuple[object, ...], Finding] = {}
    for identity in sorted(by_identity):
        alike.setdefault(identity[:3], by_identity[identity])
    return tuple(alike.values())


def _identity(finding: Finding) -> tuple[object, ...]:
    """Of one finding in several programs the one with the fewest places around it is first."""
    related = tuple((remark.place, remark.text) for remark in finding.related)
    return finding.place, finding.code, finding.message, related, finding.unit or ''


def findings_of_unit(unit: Spec, verification: Verification | None) -> tuple[Finding, ...]:
    """What the rules find in one unit."""
    return tuple(_of_unit(Context(unit, verification)))


def _of_unit(context: Context) -> Iterator[Finding]:
    for rule in RULES:
        yield from rule.check(context)


def _matters(diagnostic: Diagnostic, releases: Collection[str | None]) -> bool | None:
    """Whether it does in the releases that are named; ``None`` where that is open."""
    rule = BY_SLUG.get(diagnostic.slug)
    if rule is None or rule.since is None:
        return None
    known = {has_change(release, rule.since) for release in releases}
    return known.pop() if len(known) == 1 else None


def _of_diagnostic(diagnostic: Diagnostic, matters: bool | None) -> Finding:
    fallback = UNRESOLVED if diagnostic.severity is Severity.NOTE else UNREADABLE
    rule = BY_SLUG.get(diagnostic.slug, fallback)
    return Finding(
        code=rule.code,
        severity=Severity.ERROR if matters else diagnostic.severity,
        place=diagnostic.place,
        message=diagnostic.message,
        help=diagnostic.help,
    )
