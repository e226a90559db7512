"""
Verdicts and findings of one unit, asked anew.

``unit_jobs.py`` comes here with what the cache does not know.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from ros2cc_extract.deadline import Deadline, TimeOverError, ended_by
from ros2cc_extract.findings.base.model import Finding
from ros2cc_extract.findings.by_release import of_all_releases
from ros2cc_extract.findings.collect import findings_of_unit
from ros2cc_extract.findings.waits_across_executors import findings_of_joined
from ros2cc_extract.generator.releases import differing
from ros2cc_extract.pipeline.unit_task import Examined, Task
from ros2cc_extract.spec.close import ClosedSpec
from ros2cc_extract.spec.releases.settings import settings
from ros2cc_extract.verify.results.results import NotKept, QueryResult, Verification
from ros2cc_extract.verify.search.known_answers import Shelf
from ros2cc_extract.verify.search.options import OnProgress, Options
from ros2cc_extract.verify.undecided import failed_unit, is_defect, undecided_unit
from ros2cc_extract.verify.unit import verify_unit


def examine(
    task: Task,
    watch: OnProgress | None = None,
    deadline: Deadline | None = None,
    shelf: Shelf | None = None,
) -> Examined:
    """
    Verify one unit; only ``_with_runs`` puts runs that are not kept into words.

    An error of our own model of it is reported, and the other units go on.
    """
    try:
        return _examine(task, watch, deadline, shelf or Shelf())
    except Exception as error:
        if not is_defect(error):
            raise  # such as a program that was asked for and is not there
        shown = failed_unit(task.closed, task.options, error)
        judged = failed_unit(task.closed, task.judging, error) if task.judging else shown
        return Examined(shown, judged, _findings(task, None))


def _examine(
    task: Task, watch: OnProgress | None, deadline: Deadline | None, shelf: Shelf
) -> Examined:
    options = task.judging or task.options
    verify = partial(_verify_in_time, watch=watch, deadline=deadline, shelf=shelf)
    judged = task.answered or verify(task.closed, options)
    shown = verify(task.closed, task.options) if task.judging else judged
    rows = differing(task.closed.spec, options.profile)
    first, *others = settings(rows)
    tasks = [task.under(setting.release) for setting in others]
    answers = {task.model: judged}
    for each in tasks:
        if each.model not in answers:
            answers[each.model] = verify(each.closed, options)
    elsewhere = [answers[each.model] for each in tasks]
    found = [_findings(*each) for each in zip([task, *tasks], [judged, *elsewhere], strict=True)]
    findings = of_all_releases([*zip([first, *others], found, strict=True)], rows)
    kept = _kept(shown, task.keeps_runs)
    own = _kept(judged, False) if judged is not shown else kept
    return Examined(kept, own, findings, tuple(_kept(each, False) for each in elsewhere))


def _verify_in_time(
    closed: ClosedSpec,
    options: Options,
    watch: OnProgress | None,
    deadline: Deadline | None,
    shelf: Shelf,
) -> Verification:
    """Verify until the deadline: searches return what they know, all else is ended."""
    options = replace(options, limits=replace(options.limits, deadline=deadline))
    try:
        with ended_by(deadline):
            return verify_unit(closed, options, watch, shelf)
    except TimeOverError:
        return undecided_unit(closed, options, deadline.reason if deadline else '')


def _kept(verification: Verification, with_runs: bool) -> Verification:
    """The verification as plain data, without what differs from run to run."""
    results = tuple(_kept_result(result, with_runs) for result in verification.results)
    return replace(verification, seconds=0.0, peak_mb=0.0, results=results)


def _kept_result(result: QueryResult, with_runs: bool) -> QueryResult:
    if not result.run and not result.seconds:
        return result  # as most of a hundred thousand may be, and to copy them takes its time
    if with_runs:
        return replace(result, seconds=0.0, run=result.evidence)
    return replace(result, seconds=0.0, run=NotKept.RUN if result.run else None)


def unasked(task: Task, reason: str) -> Examined:
    """A unit that was not reached."""
    shown = undecided_unit(task.closed, task.options, reason)
    judged = undecided_unit(task.closed, task.judging, reason) if task.judging else shown
    return Examined(shown, judged, _findings(task, judged))


def _findings(task: Task, judged: Verification | None) -> tuple[Finding, ...]:
    if task.joined is not None:
        return findings_of_joined(task.joined, judged)
    return findings_of_unit(task.unit, judged)
