"""The one door to findings: from units, verdicts and diagnostics to a sorted list."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace

from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.findings.base.assumptions import with_assumptions
from ros2cc_extract.findings.base.model import Finding, Remark
from ros2cc_extract.findings.base.rule import Context
from ros2cc_extract.findings.races_across_executors import findings_across
from ros2cc_extract.findings.rules.deadlocks.never_ends import RULE as NEVER_ENDS
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import OUTSIDE_WAIT, UNDECIDED
from ros2cc_extract.findings.rules.reading.diagnostics import UNREADABLE
from ros2cc_extract.findings.rules.reading.unresolved import RULE as UNRESOLVED
from ros2cc_extract.findings.rules.registry import BY_SLUG, RULES
from ros2cc_extract.findings.rules.starvation.transform_wait import RULE as TRANSFORM_WAIT
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify.results.rates import with_arrivals
from ros2cc_extract.verify.results.results import Verification

OPEN_WAITS = (UNDECIDED.code, OUTSIDE_WAIT.code)
"""Reported for a wait if no other rule says more about it."""
_COSTS = (TRANSFORM_WAIT.code,)
"""What the time-out of one attempt costs."""
_WEIGHTS = tuple(Severity)
_NUMBER_OF_OBJECT = re.compile(r'#\d+\b')
"""By which objects of one class are told apart, in one unit and in several."""
_OF_WAITS = ('CC1', 'CC2')


def findings_of(
    units: Sequence[Spec],
    diagnostics: Iterable[Diagnostic],
    verifications: Sequence[Verification | None] = (),
) -> tuple[Finding, ...]:
    """
    All findings, the worst first, then by place and code; the order of the units does not matter.

    :param verifications: of the units, in their order; empty when none was verified.
    """
    verdicts = verifications or [None] * len(units)
    pairs = zip(with_arrivals(units), verdicts, strict=True)
    releases = {unit.rclpy for unit in units}
    found = [*(findings_of_unit(*pair) for pair in pairs), findings_across(units)]
    return all_findings(found, diagnostics, releases)


def all_findings(
    by_unit: Iterable[Iterable[Finding]],
    diagnostics: Iterable[Diagnostic],
    releases: Collection[str | None] = (),
) -> tuple[Finding, ...]:
    """
    The findings of several units and of the scan as one list, each once, the worst first.

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
    reported = {(finding.place, finding.message) for finding in found if finding.unit is None}
    by_identity = {_identity(f): f for f in found if not _is_reported(f, reported)}
    alike: dict[tuple[object, ...], list[Finding]] = {}
    for identity in sorted(by_identity):
        finding = by_identity[identity]
        what = finding.cause or _NUMBER_OF_OBJECT.sub('', finding.message)
        key = (finding.place, finding.code, what)
        alike.setdefault(key, []).append(finding)
    merged = [_as_one(findings) for findings in alike.values()]
    return tuple(sorted(_without_what_is_decided(merged), key=_worst_first))


def _without_what_is_decided(findings: Sequence[Finding]) -> Iterator[Finding]:
    """
    A wait is open only where no other rule, and no other unit, says more of its line.

    And what a time-out costs matters only where the wait ever ends.
    """
    reported = {_line(f) for f in findings if f.code[:3] in _OF_WAITS and f.code not in OPEN_WAITS}
    endless = {_line(f) for f in findings if f.code == NEVER_ENDS.code}
    for finding in findings:
        is_decided = finding.code in OPEN_WAITS and _line(finding) in reported
        if not is_decided and not (finding.code in _COSTS and _line(finding) in endless):
            yield finding


def _is_reported(finding: Finding, reported: Collection[tuple[Place, str]]) -> bool:
    """Whether the scan itself has reported at this place why something is missing."""
    reason = finding.cause or finding.message.partition(': unit ')[0]
    return reason != finding.message and (finding.place, reason) in reported


def _as_one(findings: Sequence[Finding]) -> Finding:
    """Report what has one cause once, with the number of units or objects that it shows in."""
    first = findings[0]
    if not first.cause:
        more = len({finding.message for finding in findings}) - 1
        others = 'another object' if more == 1 else f'{more} more objects'
        return replace(first, message=f'{first.message}; the same of {others}') if more else first
    more = len({finding.unit for finding in findings}) - 1
    if not more:
        return first
    others = 'another unit' if more == 1 else f'{more} more units'
    return replace(first, message=f'{first.message}; the same in {others}')


def _worst_first(finding: Finding) -> tuple[object, ...]:
    return _WEIGHTS.index(finding.severity), *_identity(finding)


def _identity(finding: Finding) -> tuple[object, ...]:
    """Of one finding in several programs the one with the fewest places around it is first."""
    related = tuple((remark.place, remark.text) for remark in finding.related)
    return finding.place, finding.code, finding.message, related, finding.unit or ''


def findings_of_unit(unit: Spec, verification: Verification | None) -> tuple[Finding, ...]:
    """What the rules find in one unit."""
    return tuple(_of_unit(Context(unit, verification)))


def _line(finding: Finding) -> tuple[str, int | None]:
    return finding.place.file, finding.place.line


def _of_unit(context: Context) -> Iterator[Finding]:
    for rule in RULES:
        for finding in rule.check(context):
            yield with_assumptions(finding, context.unit)


def _matters(diagnostic: Diagnostic, releases: Collection[str | None]) -> bool | None:
    """Whether it does in the releases that are named; ``None`` where that is open."""
    rule = BY_SLUG.get(diagnostic.slug)
    behaviour = None if rule is None else rule.since or rule.until
    if rule is None or behaviour is None:
        return None
    known = {behaviour.holds(release) for release in releases}
    has_changed = known.pop() if len(known) == 1 else None
    return has_changed if rule.since is not None or has_changed is None else not has_changed


def is_unread(finding: Finding) -> bool:
    """Whether it is about an unreadable file; that decides no exit status."""
    return finding.code == UNREADABLE.code and finding.severity is Severity.ERROR


def _of_diagnostic(diagnostic: Diagnostic, matters: bool | None) -> Finding:
    fallback = UNRESOLVED if diagnostic.severity is Severity.NOTE else UNREADABLE
    rule = BY_SLUG.get(diagnostic.slug, fallback)
    return Finding(
        code=rule.code,
        severity=Severity.ERROR if matters else diagnostic.severity,
        place=diagnostic.place,
        message=diagnostic.message,
        help=diagnostic.help,
        related=tuple(Remark(each.place, each.text) for each in diagnostic.related),
    )
