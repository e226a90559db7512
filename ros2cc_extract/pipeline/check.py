"""The whole job without its report: scan, close, verify, find, and take out what is accepted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import TextIO

from ros2cc_extract.cache_file import default_cache_folder
from ros2cc_extract.deadline import Deadline, Patience, deadline_in
from ros2cc_extract.diagnostics import Diagnostic, Severity
from ros2cc_extract.extract.extraction import Extraction
from ros2cc_extract.extract.static.program.source import SIZE_LIMIT_BYTES
from ros2cc_extract.files import DISK, Files
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.collect import all_findings, is_unread
from ros2cc_extract.findings.filters.baseline import compare
from ros2cc_extract.findings.filters.selection import select
from ros2cc_extract.findings.filters.suppress import suppress
from ros2cc_extract.findings.promises import Judgement, about, judge, weakest
from ros2cc_extract.findings.promises_of_systems import discharged
from ros2cc_extract.findings.races_across_executors import findings_across
from ros2cc_extract.findings.requirements import check_requirements
from ros2cc_extract.findings.rules.deadlocks.undecided_wait import CODE as UNDECIDED_WAIT
from ros2cc_extract.findings.system_findings import findings_of_system
from ros2cc_extract.findings.waits_across_executors import without_reported
from ros2cc_extract.jobs.pools import Pool
from ros2cc_extract.light_dataclasses import dataclass
from ros2cc_extract.pipeline.config import Config
from ros2cc_extract.pipeline.progress import bar
from ros2cc_extract.pipeline.shards import Shard
from ros2cc_extract.pipeline.system_sources import scan_paths
from ros2cc_extract.pipeline.unit_jobs import examine_all
from ros2cc_extract.pipeline.unit_task import Examined, Task, joined_task, judging_options
from ros2cc_extract.source_locations import Place
from ros2cc_extract.spec.assumptions import Assumptions, assume
from ros2cc_extract.spec.close import ClosedSpec, Policy, close, waited_for
from ros2cc_extract.spec.joined_executors import Joined
from ros2cc_extract.spec.model import Spec
from ros2cc_extract.spec.system.model import System
from ros2cc_extract.verify.results.rates import with_arrivals
from ros2cc_extract.verify.results.results import Verification
from ros2cc_extract.verify.search.options import Options

SCANNING = 0.75
"""Share of the time after which nothing more is scanned."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """
    What to check, and how.

    :param arguments: arguments of launch files among the paths, by name.
    :param known: fingerprints of findings that are accepted already.
    :param root: repository to which fingerprints are relative.
    :param shows_verdicts: the verdicts of the profile in ``options`` are wanted too, and not only
        those that findings rest on; with ``keeps_runs`` each with its run.
    :param max_seconds: for scanning all files and verifying all units together.
    :param spent_s: of these seconds, on what was checked before.
    :param files: those of the disk, or of another revision.
    :param noticed: what is known already, such as folders that cannot be looked into.
    :param pool: what runs the searches; the cores of this machine by default.
    :param shard: of all units only its own are verified and reported.
    :param answered: what models of units have answered under another release, by ``Task.model``.
    :param known_units: what shards have found, by ``Task.key``; nothing is verified then.
    """

    paths: Sequence[Path]
    config: Config
    policy: Policy
    options: Options
    assumptions: Assumptions
    root: Path
    arguments: Mapping[str, str] = field(default_factory=dict)
    known: frozenset[str] = frozenset()
    cached: bool = True
    shows_verdicts: bool = False
    keeps_runs: bool = False
    max_seconds: float | None = None
    spent_s: float = 0.0
    files: Files = DISK
    noticed: tuple[Diagnostic, ...] = ()
    pool: Pool | None = None
    shard: Shard | None = None
    answered: Mapping[str, Verification] = field(default_factory=dict)
    known_units: Mapping[str, Examined] | None = None

    @property
    def sees_all(self) -> bool:
        """Whether it can say of something that it is nowhere."""
        return self.shard is None


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """
    What came out.

    :param verifications: for the reader; ``judged`` are those that findings rest on, under all
        releases that are judged.
    :param models: of each unit, ``Task.model``.
    :param sources: text of the scanned files and of those that findings lead to, by path.
    :param accepted: how many findings a comment or the baseline accepts.
    :param promises: of each unit, what is proven, broken and undecided.
    :param system: what launch files among the paths start.
    :param interrupted: it was ended before all units were verified.
    :param answers: of a shard, what is known of its units, by ``Task.key``.
    """

    extraction: Extraction
    units: tuple[Spec, ...]
    closed: tuple[ClosedSpec, ...]
    verifications: tuple[Verification, ...]
    judged: tuple[Verification, ...]
    models: tuple[str, ...]
    findings: tuple[Finding, ...]
    accepted: int
    sources: Mapping[str, str]
    promises: tuple[tuple[Judgement, ...], ...] = ()
    interrupted: bool = False
    system: System | None = None
    answers: Mapping[str, Examined] = field(default_factory=dict)

    @property
    def summary(self) -> dict[str, int]:
        """Counts for the last line, in its order."""
        verdicts = Counter(r.verdict.value for v in self.judged for r in v.results)
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
            'notes': severities[Severity.NOTE] - len(self.undecided_waits),
            'undecided_waits': len(self.undecided_waits),
            'accepted': self.accepted,
        }

    @property
    def is_undecided(self) -> bool:
        """True when a limit left a verdict open, or a file."""
        cut = bool(self.extraction.cut)
        return cut or any(verification.is_cut for verification in self.judged)

    @property
    def undecided_waits(self) -> tuple[Finding, ...]:
        """Waits that are undecided."""
        return tuple(finding for finding in self.findings if finding.code == UNDECIDED_WAIT)

    @property
    def has_findings(self) -> bool:
        """True when something weighs more than a note, and is not that a file was not read."""
        return any(
            finding.severity is not Severity.NOTE and not is_unread(finding)
            for finding in self.findings
        )


def _has_callbacks(unit: Spec) -> bool:
    """Whether there is any that a user wrote, or that code waits for."""
    waited = waited_for(unit)
    return any(not each.builtin or each.name in waited for each in unit.callbacks)


def check_paths(job: Job, stderr: TextIO) -> Outcome:
    """Do the whole job; progress goes to ``stderr`` when it is a terminal."""
    left_s = None if job.max_seconds is None else max(0.0, job.max_seconds - job.spent_s)
    deadline = None if left_s is None else deadline_in(left_s, job.max_seconds or left_s)
    extraction, system = scan_paths(
        job.paths,
        job.arguments,
        stderr,
        cached=job.cached,
        lists_builtin=job.policy.builtin,
        files=job.files,
        patience=_patience(deadline, left_s),
    )
    units, tasks = _units_of(job, extraction)
    more = [joined_task(each, job.policy, job.options) for each in _joined(job, extraction)]
    with bar(stderr, 'verifying') as meter:
        examination = examine_all(
            [*tasks, *more],
            default_cache_folder() if job.cached else None,
            meter,
            deadline,
            pool=job.pool,
            known=job.known_units,
            interrupted=extraction.interrupted,
        )
    examined, together = examination.units[: len(tasks)], examination.units[len(tasks) :]
    defects = tuple(_defects(units, examined))
    noticed = (*job.noticed, *extraction.diagnostics, *defects)
    extraction = replace(extraction, diagnostics=noticed)
    findings = _findings(job, extraction, units, examined, together, system)
    root = job.root.as_posix()
    selected = select(findings, job.config.selection, root)
    sources = _sources(job.files, {*extraction.files_seen, *_files_shown(selected)})
    suppressed = suppress(selected, sources, extraction.files_seen if job.sees_all else ())
    compared = compare(suppressed.kept, job.known, root)
    return Outcome(
        extraction=extraction,
        units=units,
        closed=tuple(task.closed for task in tasks),
        verifications=tuple(each.shown for each in examined),
        judged=tuple(each.under_all for each in examined),
        models=tuple(task.model for task in tasks),
        findings=compared.new,
        accepted=len(suppressed.accepted) + len(compared.known),
        sources=sources,
        promises=_discharged(
            tuple(_promises(tasks, examined, findings)),
            units,
            system,
            zip(more, together, strict=True),
        ),
        interrupted=examination.interrupted,
        system=system,
        answers={} if job.sees_all else _answers([*tasks, *more], examination.found),
    )


def _units_of(job: Job, extraction: Extraction) -> tuple[tuple[Spec, ...], list[Task]]:
    """What there is to verify: all units, or those of a shard."""
    units = [
        assume(unit, job.assumptions)
        for unit in extraction.units
        if job.policy.builtin or _has_callbacks(unit)
    ]
    pairs = zip(units, with_arrivals(units), strict=True)  # the sender may be in another shard
    own = [pair for pair in pairs if job.shard is None or job.shard.holds(pair[0])]
    # Verdicts that will not be shown are not asked for.
    options = job.options if job.shows_verdicts else judging_options(job.options)
    tasks = [Task(each, close(unit, job.policy), options, job.keeps_runs) for unit, each in own]
    tasks = [replace(each, answered=job.answered.get(each.model)) for each in tasks]
    return tuple(unit for unit, _ in own), tasks


def _joined(job: Job, extraction: Extraction) -> list[Joined]:
    shard = job.shard
    return [each for each in extraction.joined if shard is None or shard.holds(each.spec)]


def _answers(tasks: Sequence[Task], found: Sequence[Examined | None]) -> dict[str, Examined]:
    pairs = zip(tasks, found, strict=True)
    return {task.key: examined for task, examined in pairs if examined is not None}


def _findings(
    job: Job,
    extraction: Extraction,
    units: Sequence[Spec],
    examined: Sequence[Examined],
    together: Sequence[Examined],
    system: System | None,
) -> tuple[Finding, ...]:
    """All findings: of the scan, of each unit, of several units, and of what is demanded."""
    own = [each.findings for each in examined]
    across = without_reported(
        (finding for each in together for finding in each.findings),
        (finding for found in own for finding in found),
    )
    of_system = findings_of_system(system) if system is not None and job.sees_all else ()
    demands = job.config.requirements if job.sees_all else ()
    return (
        *all_findings(
            [*own, findings_across(units), across, of_system],
            extraction.diagnostics,
            {unit.rclpy for unit in units},
        ),
        *check_requirements(demands, units, [each.under_all for each in examined]),
    )


def _promises(
    tasks: Sequence[Task], examined: Sequence[Examined], findings: Sequence[Finding]
) -> Iterator[tuple[Judgement, ...]]:
    """An accepted finding breaks a promise all the same."""
    units = [task.unit for task in tasks]
    for task, each in zip(tasks, examined, strict=True):
        joint, near = about(findings, task.unit, units)
        own = (*each.findings, *(finding for finding in joint if finding not in each.findings))
        verified = (each.judged, *each.elsewhere)
        yield weakest(judge(task.unit, verification, own, near) for verification in verified)


def _discharged(
    promises: tuple[tuple[Judgement, ...], ...],
    units: Sequence[Spec],
    system: System | None,
    together: Iterable[tuple[Task, Examined]],
) -> tuple[tuple[Judgement, ...], ...]:
    """In a system a promise rests on those of others."""
    if system is None:
        return promises
    pairs = [(task.joined, each.under_all) for task, each in together if task.joined]
    return discharged(promises, units, system, pairs)


def _patience(deadline: Deadline | None, seconds: float | None) -> Patience:
    """Scanning leaves some time to verify what was found."""
    if deadline is None or seconds is None:
        return Patience(keeps_interrupted=True)
    scanning = replace(deadline, at=deadline.at - (1 - SCANNING) * seconds)
    return Patience(scanning, keeps_interrupted=True)


def _defects(units: Sequence[Spec], examined: Sequence[Examined]) -> Iterator[Diagnostic]:
    """Report the units that could not be verified because of a defect of this tool."""
    for unit, each in zip(units, examined, strict=True):
        if each.shown.defect:
            yield Diagnostic(
                severity=Severity.ERROR,
                slug='defect',
                place=unit.executor.source
                or Place(unit.sources[0] if unit.sources else unit.name),
                message=f'unit {unit.name} is not verified: {each.shown.defect}',
                help='this is a defect of the tool; ROS2CC_TRACEBACK=1 shows where',
            )


def _files_shown(findings: Sequence[Finding]) -> set[str]:
    """Files that findings lead to, also those that a checked file only imports."""
    remarks = [remark for finding in findings for remark in (*finding.chain, *finding.related)]
    places = [*(finding.place for finding in findings), *(remark.place for remark in remarks)]
    return {place.file for place in places}


def _sources(files: Files, names: Collection[str]) -> dict[str, str]:
    texts = {}
    for name in sorted(names):
        try:
            data = files.read(Path(name), SIZE_LIMIT_BYTES)
        except (OSError, ValueError):  # not there, or no name that a file can have
            continue
        texts[name] = data.decode(errors='replace').replace('\r\n', '\n').replace('\r', '\n')
    return texts
