"""The whole job without its telling: scan, close, verify, find, and take out what is accepted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cli.config import Config
from ros2cc_extract.cli.progress import search_progress
from ros2cc_extract.cli.sources import scan_sources
from ros2cc_extract.diagnostics import Severity
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.findings.baseline import compare
from ros2cc_extract.findings.collect import findings_of
from ros2cc_extract.findings.model import Finding
from ros2cc_extract.findings.requirements import check_requirements
from ros2cc_extract.findings.selection import select
from ros2cc_extract.findings.suppress import suppress
from ros2cc_extract.generator.build import Profile
from ros2cc_extract.spec.assume import Assumptions, assume
from ros2cc_extract.spec.close import ClosedSpec, Policy, close
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.verify import Checker, Options, Verification, verify_unit

LONGEST_JUDGEMENT_S = 10.0


@dataclass(frozen=True, kw_only=True)
class Job:
    """
    What to check, and how.

    :param known: fingerprints of findings that are accepted already.
    :param root: repository to which fingerprints are relative.
    """

    paths: Sequence[Path]
    config: Config
    policy: Policy
    options: Options
    assumptions: Assumptions
    root: Path
    known: frozenset[str] = frozenset()
    cached: bool = True


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """
    What came out.

    :param sources: text of the scanned files, by the path that places name.
    :param accepted: how many findings a comment or the baseline accepts.
    """

    extraction: Extraction
    units: tuple[Spec, ...]
    closed: tuple[ClosedSpec, ...]
    verifications: tuple[Verification, ...]
    findings: tuple[Finding, ...]
    accepted: int
    sources: Mapping[str, str]

    @property
    def summary(self) -> dict[str, int]:
        """Counts for the last line, in its order."""
        verdicts = Counter(r.verdict.value for v in self.verifications for r in v.results)
        severities = Counter(finding.severity for finding in self.findings)
        return {
            'files': len(self.extraction.files_seen),
            'units': len(self.units),
            'callbacks': sum(len(unit.callbacks) for unit in self.units),
            'satisfied': verdicts['satisfied'],
            'not_satisfied': verdicts['not satisfied'],
            'undecided': verdicts['undecided'],
            'errors': severities[Severity.ERROR],
            'warnings': severities[Severity.WARNING],
            'notes': severities[Severity.NOTE],
            'accepted': self.accepted,
        }

    @property
    def is_undecided(self) -> bool:
        """True when a limit left a verdict open."""
        return any(verification.is_undecided for verification in self.verifications)

    @property
    def has_findings(self) -> bool:
        """True when something weighs more than a note."""
        return any(finding.severity is not Severity.NOTE for finding in self.findings)


def check_paths(job: Job, stderr: TextIO) -> Outcome:
    """Do the whole job; progress goes to ``stderr`` when it is a terminal."""
    extraction = scan_sources(job.paths, stderr, cached=job.cached)
    units = tuple(assume(unit, job.assumptions) for unit in extraction.units)
    closed = tuple(close(unit, job.policy) for unit in units)
    verifications = tuple(_verify(each, job.options, stderr) for each in closed)
    judged = tuple(
        _judge(each, verification, job.options)
        for each, verification in zip(closed, verifications, strict=True)
    )
    sources = _sources(extraction.files_seen)
    findings = (
        *findings_of(units, extraction.diagnostics, judged),
        *check_requirements(job.config.requirements, units, judged),
    )
    root = job.root.as_posix()
    suppressed = suppress(select(findings, job.config.selection, root), sources)
    compared = compare(suppressed.kept, job.known, root)
    return Outcome(
        extraction=extraction,
        units=units,
        closed=closed,
        verifications=verifications,
        findings=compared.new,
        accepted=len(suppressed.accepted) + len(compared.known),
        sources=sources,
    )


def _verify(closed: ClosedSpec, options: Options, stderr: TextIO) -> Verification:
    with search_progress(stderr, closed.spec.name) as progress:
        return verify_unit(closed, options, progress)


def _judge(closed: ClosedSpec, shown: Verification, options: Options) -> Verification:
    """Findings rest on rclpy's own executors, whichever model the table shows."""
    if options.profile is Profile.RCLPY or options.checker is not Checker.EMBEDDED:
        return shown
    seconds = min(options.limits.seconds or LONGEST_JUDGEMENT_S, LONGEST_JUDGEMENT_S)
    limits = replace(options.limits, seconds=seconds)
    return verify_unit(closed, replace(options, profile=Profile.RCLPY, limits=limits))


def _sources(files: Sequence[str]) -> dict[str, str]:
    texts = {}
    for file in files:
        try:
            texts[file] = Path(file).read_text(encoding='utf-8', errors='replace')
        except OSError:
            continue
    return texts
